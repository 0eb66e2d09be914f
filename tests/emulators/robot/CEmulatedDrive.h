// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/simulator/COdometryModel.h>
#include <salma/simulator/CSimulator.h>

#include <filesystem>
#include <memory>
#include <vector>

#include "CEviD30.h"
#include "CPictureFolder.h"
#include "CTalker.h"
#include "CWorldClock.h"
#include "CWorldScanner.h"

namespace salma::test {

/** A robot that drives through a world of salma-sim while programs read its devices: laser
 * (LMS 200), head (EVI-D30) and base (CTalker, `$ODO`) on pseudo-terminals, the camera's pictures
 * in a folder. Nothing else connects the programs with the world.
 *
 * Somebody turns the head with its remote control, as the world's head plan says. The robot stands
 * at its start for the first `standing` pictures, and at its end for as many as anybody looks at.
 */
class CEmulatedDrive {
 public:
    /** \param folder Exists; gets `laser`, `head`, `base` and `pictures/`, `robot.ini` for a
     * grabber (share/grabber/robot.ini with these devices) and `camera.ini` for rawlog-edit's
     * --camera-params.
     * \param standing Pictures before the drive, while programs find their devices. */
    CEmulatedDrive(const simulator::TWorld& description,
                   std::uint32_t seed,
                   const std::filesystem::path& folder,
                   std::size_t standing);
    ~CEmulatedDrive();
    CEmulatedDrive(const CEmulatedDrive&) = delete;
    CEmulatedDrive& operator=(const CEmulatedDrive&) = delete;

    /// True once the drive is over.
    bool arrived() const;

    /// Where the robot was whenever its base spoke, by the computer's clock, as a TUM file.
    void writeTruth(const std::filesystem::path& file);

    const simulator::CSimulator& simulator() const { return m_simulator; }
    /// T_w_r before the drive.
    mrpt::math::TPose2D start() const { return m_path.pose(0); }

 private:
    struct TTruePose {
        double stamp;  //!< By the computer's clock [s].
        mrpt::math::TPose2D T_w_r;
    };

    static std::vector<double> pictureTimes(const simulator::CHeadPlan& plan, std::size_t standing);
    void writePictures(const std::filesystem::path& folder, std::size_t standing);
    void writeSettings(const std::filesystem::path& folder) const;
    double picturePeriod() const;
    std::vector<double> odometry(double now);
    void turnHead();

    simulator::TWorld m_description;
    simulator::CSimulator m_simulator;
    simulator::CPath m_path;
    simulator::CHeadPlan m_plan;
    std::vector<double> m_times;  //!< Of the files, in the world.
    CWorldClock m_clock;
    simulator::COdometryModel m_wheels;
    std::vector<TTruePose> m_truth;  //!< Locked with m_baseEnd.
    CWorldScanner m_scanner;
    CSickLms200 m_laser;
    CEviD30 m_head;
    CTalker m_base;
    std::unique_ptr<CPictureFolder> m_pictures;
    std::unique_ptr<CEmulator> m_laserEnd, m_headEnd, m_baseEnd;
    std::atomic<bool> m_stop{false};
    std::thread m_remoteControl;
};

}  // namespace salma::test
