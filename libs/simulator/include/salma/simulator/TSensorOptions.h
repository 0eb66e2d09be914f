// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/core/bits_math.h>
#include <salma/config/TStrictOptions.h>

#include <string>
#include <vector>

namespace salma::simulator {

enum class EAperture { deg180, deg100 };
enum class EResolution { half, one };
enum class ELaserMode { mm, cm };

/** Section [laser]: a SICK LMS 200.
 * Source: Ho, transfer report 2004, section 4.4.1. */
struct TLaserOptions : public config::TStrictOptions<TLaserOptions> {
    EAperture aperture{EAperture::deg180};
    EResolution resolution{EResolution::half};
    ELaserMode mode{ELaserMode::mm};
    double rate{5};           //!< Scans per second [Hz].
    double jitter{0.004};     //!< Sigma of the time of a scan [s].
    double x{0.18};           //!< Forward of the robot's centre [m].
    double z{0.40};           //!< Height of the beam [m].
    double noise{0.005};      //!< Sigma of a range [m].
    double maxOffset{0.015};  //!< The run's constant offset is drawn from +- this [m].
    double beamWidth{mrpt::DEG2RAD(0.25)};  //!< Full angle of the beam; edges in it mix [rad].
    double statedNoise{0};  //!< Sigma that the records state instead of `noise`; 0: the true [m].
    double silentEvery{0};  //!< Mean time from one silence to the next; 0: never silent [s].
    double silent{3};       //!< How long a silence lasts [s].

    void visit(config::COptionVisitor& v);

    double apertureAngle() const;    //!< [rad]
    double resolutionAngle() const;  //!< [rad]
    std::size_t beams() const;
    double maxRange() const;  //!< 8.191 or 81.91 [m].
    double quantum() const;   //!< 0.001 or 0.01 [m].
};

enum class EPictureSize { evi768x492, vga640x480 };

/// Section [camera]: intrinsics and flaws of the camera.
struct TCameraOptions : public config::TStrictOptions<TCameraOptions> {
    EPictureSize size{EPictureSize::evi768x492};
    double horizontalField{mrpt::DEG2RAD(48.8)};  //!< Of the undistorted picture's width [rad].
    double pixelAspect{1};                        //!< fy / fx.
    double k1{-0.14}, k2{0.06}, k3{0};            //!< Radial distortion.
    double p1{0.0006}, p2{-0.0004};               //!< Tangential distortion.
    double exposureTime{0.004};                   //!< [s]
    double exposureSigma{0.05};                   //!< Of the logarithm of a picture's gain.
    double blur{0.55};                            //!< Sigma of the lens [px].
    double noise{1.6};                            //!< Sigma of the sensor [grey levels of 255].
    double vignetting{0.12};                      //!< Light lost at the corners [-].
    double latency{0};                            //!< Stamp minus true time of the picture [s].
    double latencyJitter{0};                      //!< Sigma of that beside its mean [s].
    int jpegQuality{85};

    void visit(config::COptionVisitor& v);
    int columns() const { return size == EPictureSize::evi768x492 ? 768 : 640; }
    int rows() const { return size == EPictureSize::evi768x492 ? 492 : 480; }
};

enum class EHeadMode { fixed, sweep, attend };

/// Section [head]: the pan/tilt head that carries the camera, and when it takes pictures.
struct THeadOptions : public config::TStrictOptions<THeadOptions> {
    std::string mode{"sweep"};                    //!< "fixed:DEG", "sweep" or "attend".
    std::vector<double> stops{-58, -34, 34, 58};  //!< Of a sweep, there and back again [deg].
    double speed{mrpt::DEG2RAD(80.0)};            //!< [rad/s]
    double settle{0.2};                           //!< From arrival to the picture [s].
    double dwell{0.36};                           //!< From arrival to departure [s].
    double period{0.8};                           //!< Between pictures if the head stays [s].
    double attendRange{5};                        //!< Posters farther away are let be [m].
    double tilt{0};                               //!< Upwards [rad].
    double x{0.10};                               //!< Pan axis forward of the robot's centre [m].
    double z{1.35};                               //!< Height of the tilt axis [m].
    double cameraForward{0.04};                   //!< Camera centre before the axes [m].
    double rate{10};                              //!< Pan/tilt records per second [Hz].
    double jitter{0.005};                         //!< Sigma of the times [s].

    void visit(config::COptionVisitor& v);
    void validate() const;
    EHeadMode kind() const;
    double fixedPan() const;  //!< Of "fixed:DEG" [rad].
};

enum class EOdometryNoise { low, medium, high };

/** Section [odometry]: increments with random and systematic errors.
 *
 * The sigmas are those of `medium`; `low` and `high` multiply all of them so that on the 60 m
 * hallway the position's sigma after one lap is below, equal to, and four times the spacing of the
 * doors, 2.5 m. The systematic ones are drawn once per run. */
struct TOdometryOptions : public config::TStrictOptions<TOdometryOptions> {
    EOdometryNoise level{EOdometryNoise::medium};
    double rate{20};                           //!< Records per second [Hz].
    double jitter{0.002};                      //!< Sigma of the time of a record [s].
    double scaleSigma{0.01};                   //!< Systematic, of distances [-].
    double turnScaleSigma{0.021};              //!< Systematic, of angles [-].
    double driftSigma{mrpt::DEG2RAD(0.265)};   //!< Systematic turn per metre [rad/m].
    double distanceSigma{0.02};                //!< Random, per square root of metre [m].
    double headingSigma{mrpt::DEG2RAD(1.06)};  //!< Random, per square root of metre [rad].
    double turnSigma{mrpt::DEG2RAD(1.0)};      //!< Random, per square root of radian turned [rad].
    double slipsPerMetre{0};                   //!< Mean number of times that a wheel slips [1/m].
    double slip{0.1};                          //!< Sigma of the distance that a slip feigns [m].
    double slipTurn{mrpt::DEG2RAD(1.0)};       //!< Sigma of the turn that a slip feigns [rad].

    void visit(config::COptionVisitor& v);
    double factor() const;  //!< What `level` multiplies the sigmas by.
};

}  // namespace salma::simulator
