// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservationImage.h>

#include <cstddef>
#include <functional>
#include <map>
#include <opencv2/core/types.hpp>
#include <string>

namespace salma::apps {

/** Looks for pictures that are of no use while they are recorded.
 *
 * Of each picture it is checked that its file is there and whole; its content only once a second
 * for each camera, which costs little. Says each kind of fault once for each camera, and counts. */
class CPictureWatch {
 public:
    /// \param tell Takes one line for the user.
    CPictureWatch(std::string imagesFolder, std::function<void(const std::string&)> tell);

    void look(const mrpt::obs::CObservationImage& picture);
    /// "CAMERA black" and how often, of the pictures that were looked at.
    const std::map<std::string, std::size_t>& faults() const { return m_faults; }

 private:
    /// "" if the file of an external picture is there and ends as its format wants.
    std::string faultOfFile(const std::string& file) const;
    std::string faultOfContent(const mrpt::obs::CObservationImage& picture);
    void note(const std::string& camera, const std::string& fault, const std::string& name);

    std::string m_imagesFolder;
    std::function<void(const std::string&)> m_tell;
    std::map<std::string, mrpt::Clock::time_point> m_lastLook;  //!< By camera.
    std::map<std::string, cv::Size> m_sizes;
    std::map<std::string, std::size_t> m_faults;
};

}  // namespace salma::apps
