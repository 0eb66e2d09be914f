// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/landmarks/CLandmarkRecorder.h>
#include <salma/sensing/CJoinQueue.h>

#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace salma::sensing {

/// What the front end made of a picture.
struct TWorkedPicture {
    TDecidedPicture picture;
    landmarks::TRecorded recorded;  //!< Its record is null where `error` says why.
    std::string error;
};

/** Front-end work beside the sensors' own: in threads of its own, and never with a queue. One
 * picture waits at most; a newer one takes its place. All methods may be called from any thread. */
class CFrontEndWorker {
 public:
    /** \param imagesFolder Where external pictures lie.
     * \throw std::invalid_argument if options are out of range. */
    CFrontEndWorker(const landmarks::TRecorderOptions& options,
                    std::string imagesFolder,
                    std::size_t threads);
    /// Waits for the pictures in work; what they gave is lost, as is the one that waits.
    ~CFrontEndWorker();
    CFrontEndWorker(const CFrontEndWorker&) = delete;
    CFrontEndWorker& operator=(const CFrontEndWorker&) = delete;

    /// False if a picture that waited was dropped for this one.
    bool offer(TDecidedPicture picture);

    /// What was finished since the last call.
    std::vector<TWorkedPicture> take();

    /// Nothing waits, nothing is in work, nothing is left to take.
    bool isIdle() const;

 private:
    void run();
    TWorkedPicture work(TDecidedPicture picture) const;

    const landmarks::CLandmarkRecorder m_recorder;
    const std::string m_imagesFolder;
    mutable std::mutex m_mutex;  //!< Of all that follows.
    std::condition_variable m_news;
    std::optional<TDecidedPicture> m_waiting;
    std::size_t m_inWork{0};
    std::vector<TWorkedPicture> m_finished;
    bool m_stop{false};
    std::vector<std::thread> m_threads;
};

}  // namespace salma::sensing
