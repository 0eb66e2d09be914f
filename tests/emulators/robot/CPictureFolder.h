// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <string>
#include <thread>

namespace salma::test {

/// A folder of pictures `NNNN.png`, and a thread that tells which of them is being looked at.
class CPictureFolder {
 public:
    /// \param folder Exists. \param looked Called with the number of a file when it is opened.
    CPictureFolder(const std::filesystem::path& folder,
                   std::function<void(std::size_t index)> looked);
    ~CPictureFolder();
    CPictureFolder(const CPictureFolder&) = delete;
    CPictureFolder& operator=(const CPictureFolder&) = delete;

    /// E.g. "0007.png".
    static std::string name(std::size_t index);

 private:
    void watch();

    std::function<void(std::size_t)> m_looked;
    int m_events;
    std::atomic<bool> m_stop{false};
    std::thread m_thread;
};

}  // namespace salma::test
