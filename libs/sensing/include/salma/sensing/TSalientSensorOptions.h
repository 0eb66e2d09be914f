// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/sensing/TAttentionOptions.h>

#include <string>

namespace salma::sensing {

/// A section of a rawlog-grabber ini file with `driver = CSalientLandmarkSensor`.
struct TSalientSensorOptions : public config::TStrictOptions<TSalientSensorOptions> {
    std::string driver{"CSalientLandmarkSensor"};  //!< The keys up to `ignore` keep MRPT's names.
    std::string sensorLabel;                       //!< Empty: the picture's, and "_SALIENT".
    double processRate{50};                        //!< Looks for new observations a second.
    int maxQueue{1000};
    int decimation{0};
    std::string ignore{"false"};

    std::string camera, laser;   //!< Sections of the same file.
    std::string head, odometry;  //!< Likewise; empty: there is none.
    std::string config;          //!< A config.ini of salma-slam; empty: its defaults.
    std::string cameraParams;    //!< File with [CAMERA_PARAMS]; empty: as the pictures say.
    TAttentionOptions attention;
    int threads{1};    //!< Pictures that are worked on at the same time.
    double wait{0.5};  //!< Longest wait for scan, head and odometry of a picture [s].
    double report{
        60};  //!< Time between two lines that tell what was dropped [s]; 0: at the end only.

    void visit(config::COptionVisitor& visitor);
    /// \throw std::invalid_argument naming the key.
    void validate() const;
};

}  // namespace salma::sensing
