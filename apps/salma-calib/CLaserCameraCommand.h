// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/calibration/CLaserCameraCalibrator.h>

#include <CLI/CLI.hpp>
#include <ostream>
#include <string>
#include <vector>

#include "TBoardArguments.h"

namespace salma::apps {

class COutputFolder;

/** `salma-calib laser-camera IMAGE... --scans FILE --camera INI --board CxR --square-m S --out
 * DIR`: the camera's pose on the robot from boards that laser and camera see. */
class CLaserCameraCommand {
 public:
    /// `app` may parse only while this object lives.
    explicit CLaserCameraCommand(CLI::App& app);
    CLaserCameraCommand(const CLaserCameraCommand&) = delete;
    CLaserCameraCommand& operator=(const CLaserCameraCommand&) = delete;

    bool isChosen() const { return m_command->parsed(); }

    /** Writes all files, or none if it fails; what was found to `out`.
     * \throw std::invalid_argument, std::runtime_error naming the file at fault. */
    void run(std::ostream& out);

 private:
    /// All that the run has found out.
    struct TRun {
        TSeenBoards seen;
        mrpt::img::TCamera camera;
        std::vector<calibration::TLaserBoardPair> pairs;
        calibration::TLaserCameraCalibration result;
    };

    void checkUsage();
    TRun calibrate() const;
    mrpt::poses::CPose3D laserPose() const;  //!< T_r_l
    void writeResults(const COutputFolder& folder, const TRun& run) const;
    void writeReport(const COutputFolder& folder, const TRun& run) const;

    CLI::App* m_command;
    TBoardArguments m_board;
    calibration::TLaserCameraOptions m_options;
    std::string m_scans;
    std::size_t m_firstScan{1};
    bool m_clockwise{false};
    std::string m_camera;
    std::string m_label{"CAMERA1"};
    std::vector<double> m_laserPose{0, 0, 0, 0, 0, 0};
    std::string m_out;
    std::string m_configFile;
    bool m_printConfig{false};
};

}  // namespace salma::apps
