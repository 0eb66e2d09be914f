// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservationImage.h>

#include <opencv2/core/mat.hpp>
#include <string>

namespace salma::observations {

/** The picture of an observation: 8 bit, one channel (grey) or three (BGR), as it is stored.
 *
 * MRPT finds external pictures through a folder that the whole process shares; here the folder is
 * an argument, so several logs and threads do not disturb each other. Nothing is kept in the
 * observation; the result owns its pixels.
 * \param imagesFolder Folder of external pictures, TLog::imagesFolder.
 * \throw std::runtime_error naming the file: missing, not a picture, or (embedded) empty. */
cv::Mat loadPicture(const mrpt::obs::CObservationImage& observation,
                    const std::string& imagesFolder);

/// loadPicture() with colours turned to grey; one channel.
cv::Mat loadGrey(const mrpt::obs::CObservationImage& observation, const std::string& imagesFolder);

/// False where the external file is not there or the embedded picture is empty; a file that is
/// there is not opened.
bool hasPicture(const mrpt::obs::CObservationImage& observation, const std::string& imagesFolder);

/// Path of the external file of a picture; "" if the picture is embedded in the log.
std::string pictureFileOf(const mrpt::obs::CObservationImage& observation,
                          const std::string& imagesFolder);

}  // namespace salma::observations
