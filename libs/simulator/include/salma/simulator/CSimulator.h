// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservation.h>
#include <salma/observations/CObservationPanTilt.h>
#include <salma/simulator/CBankedFrontEnd.h>
#include <salma/simulator/CHeadPlan.h>
#include <salma/simulator/CImageSensor.h>
#include <salma/simulator/CLaserModel.h>
#include <salma/simulator/COdometryModel.h>
#include <salma/simulator/CPeople.h>
#include <salma/simulator/CScenes.h>

#include <filesystem>
#include <functional>
#include <map>
#include <vector>

namespace salma::simulator {

struct TSimulationOptions {
    std::uint32_t seed{1};
    int threads{1};  //!< That render pictures; the result does not depend on it.
    /// If set, nothing is rendered: records of what the front end would see are drawn from it.
    std::shared_ptr<const CSightingBank> bank{};
    bool pictures{true};  //!< False: the log names pictures that are not drawn.
};

/// A landmark seen at one instant; a row of NAME.sightings.csv.
struct TSighting {
    double stamp{0};  //!< Of the picture or scan [s since 1970].
    int landmark{0};
    double u{0}, v{0};  //!< Of a poster's centre [px]; NaN for a corner.
    double range{0};    //!< From the robot's centre, in the plane [m].
    double bearing{0};  //!< In the robot frame [rad].
};

/// What a run produced.
struct TSimulationSummary {
    double duration{0};  //!< [s]
    std::size_t pictures{0}, scans{0}, odometryRecords{0}, panTiltRecords{0};
    std::size_t salientRecords{0};  //!< Drawn from a bank.
    double odometryMiss{0};         //!< Distance of the raw odometry's end from the true end [m].
    double laserOffset{0};          //!< Systematic error of the run's ranges [m].
};

/** Drives a robot through a world and writes what its sensors record, and the truth.
 *
 * Same world, options and seed: same bytes. Stamps count from a fixed instant, 1700000000 s. */
class CSimulator {
 public:
    CSimulator(const TWorld& description, const TSimulationOptions& options);

    std::size_t pictureCount() const { return m_head.pictureTimes().size(); }

    /** Writes NAME.rawlog, NAME_Images/, NAME.gt.tum, NAME.landmarks.csv and NAME.sightings.csv to
     * `folder`, which exists. Pan/tilt records go to the companion NAME.salient.rawlog, since stock
     * programs cannot read a log past the first of them. With a bank, CObservationSalientLandmarks
     * go there too, and there are no pictures. \param onPicture Called after each picture, from
     * several threads. \throw std::runtime_error if a file cannot be written. */
    TSimulationSummary run(const std::filesystem::path& folder,
                           const std::function<void()>& onPicture = {});

    /// T_w_r [m, rad] `time` seconds after the start.
    mrpt::math::TPose2D truePose(double time) const { return m_path.pose(time); }

    /// T_w_c, optical frame.
    mrpt::poses::CPose3D cameraPose(double time) const;

    /// T_r_c, optical frame.
    mrpt::poses::CPose3D cameraOnRobot(double time) const { return headState(time).cameraPose(); }

    /// Pan of the head, left is positive [rad].
    double pan(double time) const { return m_head.pan(time); }

    /// When picture `index` is taken [s after the start].
    double pictureTime(std::size_t index) const;

    /// When scans are taken [s after the start], increasing.
    const std::vector<double>& scanTimes() const { return m_scanTimes; }

    /// The scan taken at scanTimes()[index], without stamp.
    mrpt::obs::CObservation2DRangeScan scan(std::size_t index) const;

    /// The picture taken at pictureTimes()[index], 8-bit BGR.
    cv::Mat picture(std::size_t index) const;

    /// Posters whose centre picture `index` shows, not hidden by anything.
    std::vector<TSighting> sightingsInPicture(std::size_t index) const;

    /// Of the first lap, on the first floor of the path.
    const CWorld& world() const { return worldAt(0); }

    /// What stands around the robot at that time [s after the start], without people.
    const CWorld& worldAt(double time) const {
        return m_scenes.at(m_path.lap(time), m_path.floor(time));
    }

    /// Those of all laps and floors.
    const std::vector<TTrueLandmark>& landmarks() const { return m_scenes.landmarks(); }

    const CPeople& people() const { return m_people; }

    /// The motion from one time to a later one as wheels of medium noise would have it: T_from_to.
    /// \param draw Which errors are drawn.
    mrpt::math::TPose2D wheelMotion(double from, double to, std::uint32_t draw) const;
    const CCameraModel& camera() const { return m_camera; }

 private:
    using Records = std::vector<mrpt::obs::CObservation::Ptr>;

    observations::CObservationPanTilt headState(double time) const;
    /// The picture's stamp less that of the start [s].
    double pictureStamp(std::size_t index) const;
    std::vector<double> scanInstants() const;
    std::string pictureName(std::size_t index) const;
    std::vector<double> instants(double rate,
                                 double phase,
                                 double jitter,
                                 const char* purpose) const;
    std::vector<TSighting> sightingsInScan(double time) const;
    void addPictures(Records& records) const;
    Records sightingsFromBank() const;
    void addScans(Records& records, std::vector<TSighting>& sightings) const;
    Records headStates() const;
    void addOdometry(Records& records, TSimulationSummary& summary) const;
    void writePictures(const std::filesystem::path& folder,
                       const std::function<void()>& onPicture) const;
    void writePicture(const std::filesystem::path& folder, std::size_t index) const;

    TWorld m_description;
    TSimulationOptions m_options;
    CScenes m_scenes;
    CPath m_path;
    CPeople m_people;
    CHeadPlan m_head;
    CCameraModel m_camera;
    CImageSensor m_sensor;
    std::map<const CWorld*, CLaserModel> m_lasers;  //!< One in each scene.
    std::vector<double> m_scanTimes;
};

}  // namespace salma::simulator
