// SPDX-License-Identifier: BSD-3-Clause
#include <salma/simulator/TSensorOptions.h>

#include <charconv>
#include <cmath>
#include <optional>
#include <stdexcept>

namespace salma::simulator {

using config::anyNumber;
using config::atLeast;
using config::between;
using config::COptionVisitor;
using config::moreThan;
using mrpt::DEG2RAD;

namespace {

/// Angle [deg] of "fixed:DEG"; nothing if `text` is not of that form or beyond the head's +-100.
std::optional<double> fixedDegrees(const std::string& text) {
    const std::string start = "fixed:";
    if (text.compare(0, start.size(), start) != 0) return std::nullopt;
    double angle = 0;
    const char* end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data() + start.size(), end, angle);
    if (error != std::errc() || last != end || !(std::abs(angle) <= 100)) return std::nullopt;
    return angle;
}

}  // namespace

void TLaserOptions::visit(COptionVisitor& v) {
    v.choice("aperture_deg", aperture, {{"180", EAperture::deg180}, {"100", EAperture::deg100}},
             "field of view");
    v.choice("resolution_deg", resolution, {{"0.5", EResolution::half}, {"1", EResolution::one}},
             "angle between beams");
    v.choice("mode", mode, {{"mm", ELaserMode::mm}, {"cm", ELaserMode::cm}},
             "mm: to 8.191 m; cm: to 81.91 m in steps of 1 cm");
    v.number("rate_hz", rate, between(0.1, 75), "scans per second");
    v.number("jitter_s", jitter, between(0, 0.1), "sigma of the times of the scans");
    v.number("x_m", x, between(-2, 2), "forward of the robot's centre");
    v.number("z_m", z, between(0.01, 3), "height of the beam");
    v.number("noise_m", noise, between(0, 1), "sigma of a range");
    v.number("max_offset_m", maxOffset, between(0, 1),
             "the run's constant offset lies within plus and minus this");
    v.degrees("beam_width_deg", beamWidth, between(0, 2), "an edge inside the beam mixes ranges");
    v.number("stated_noise_m", statedNoise, between(0, 1),
             "sigma that the records state; 0: the true one");
    v.number("silent_every_s", silentEvery, atLeast(0),
             "mean time between silences of the laser; 0: none");
    v.number("silent_s", silent, between(0, 60), "how long a silence lasts");
}

double TLaserOptions::apertureAngle() const {
    return DEG2RAD(aperture == EAperture::deg180 ? 180.0 : 100.0);
}

double TLaserOptions::resolutionAngle() const {
    return DEG2RAD(resolution == EResolution::half ? 0.5 : 1.0);
}

std::size_t TLaserOptions::beams() const {
    return static_cast<std::size_t>(std::lround(apertureAngle() / resolutionAngle())) + 1;
}

double TLaserOptions::maxRange() const { return mode == ELaserMode::mm ? 8.191 : 81.91; }
double TLaserOptions::quantum() const { return mode == ELaserMode::mm ? 0.001 : 0.01; }

void TCameraOptions::visit(COptionVisitor& v) {
    v.choice("picture_size", size,
             {{"768x492", EPictureSize::evi768x492}, {"640x480", EPictureSize::vga640x480}},
             "columns x rows");
    v.degrees("horizontal_field_deg", horizontalField, between(4, 120),
              "field of the pinhole model over the picture's width; EVI-D30: 4.4 to 48.8");
    v.number("pixel_aspect", pixelAspect, between(0.5, 2), "fy / fx");
    v.number("k1", k1, between(-0.5, 0.5), "radial distortion");
    v.number("k2", k2, between(-0.5, 0.5), "radial distortion");
    v.number("k3", k3, between(-0.5, 0.5), "radial distortion");
    v.number("p1", p1, between(-0.05, 0.05), "tangential distortion");
    v.number("p2", p2, between(-0.05, 0.05), "tangential distortion");
    v.number("exposure_time_s", exposureTime, between(0, 0.1), "what moves in it is smeared");
    v.number("exposure_sigma", exposureSigma, between(0, 0.5),
             "sigma of the logarithm of the pictures' brightness");
    v.number("blur_px", blur, between(0, 5), "sigma of the lens");
    v.number("noise_grey", noise, between(0, 50), "sigma of the sensor, of 255");
    v.number("vignetting", vignetting, between(0, 0.9), "light lost at the corners");
    v.number("latency_s", latency, between(-1, 1), "stamp minus true time of a picture");
    v.number("latency_jitter_s", latencyJitter, between(0, 0.1), "sigma of the latency");
    v.integer("jpeg_quality", jpegQuality, between(1, 100), "of the picture files");
}

void THeadOptions::visit(COptionVisitor& v) {
    v.text("mode", mode, "fixed:DEG, sweep or attend (to the nearest poster)");
    v.numbers("stops_deg", stops, between(-100, 100), "pan angles of a sweep, left is positive");
    v.degrees("speed_deg_s", speed, between(1, 80), "pan speed");
    v.number("settle_s", settle, atLeast(0.05), "from arrival to the picture");
    v.number("dwell_s", dwell, between(0.1, 60), "from arrival to departure");
    v.number("period_s", period, between(0.05, 60), "between pictures if the head stays");
    v.number("attend_range_m", attendRange, moreThan(0), "posters farther away are let be");
    v.degrees("tilt_deg", tilt, between(-25, 25), "upwards");
    v.number("x_m", x, between(-2, 2), "pan axis forward of the robot's centre");
    v.number("z_m", z, between(0.05, 3), "height of the axes");
    v.number("camera_forward_m", cameraForward, between(-0.5, 0.5),
             "camera centre before the axes");
    v.number("rate_hz", rate, between(0.5, 100), "pan/tilt records per second");
    v.number("jitter_s", jitter, between(0, 0.04), "sigma of the times of pictures and records");
}

void THeadOptions::validate() const {
    if (mode != "sweep" && mode != "attend" && !fixedDegrees(mode))
        throw std::invalid_argument("mode = '" + mode +
                                    "' is not fixed:DEG (within 100), sweep or attend");
    if (stops.empty()) throw std::invalid_argument("stops_deg = '' holds no angle");
    if (!(settle < dwell))
        throw std::invalid_argument("settle_s = " + std::to_string(settle) +
                                    " must be below dwell_s = " + std::to_string(dwell));
}

EHeadMode THeadOptions::kind() const {
    if (mode == "sweep") return EHeadMode::sweep;
    return mode == "attend" ? EHeadMode::attend : EHeadMode::fixed;
}

double THeadOptions::fixedPan() const { return DEG2RAD(fixedDegrees(mode).value()); }

void TOdometryOptions::visit(COptionVisitor& v) {
    v.choice("noise_level", level,
             {{"low", EOdometryNoise::low},
              {"medium", EOdometryNoise::medium},
              {"high", EOdometryNoise::high}},
             "multiplies the sigmas below");
    v.number("rate_hz", rate, between(1, 100), "records per second");
    v.number("jitter_s", jitter, between(0, 0.01), "sigma of the times of the records");
    v.number("scale_sigma", scaleSigma, between(0, 0.2), "systematic, of distances");
    v.number("turn_scale_sigma", turnScaleSigma, between(0, 0.2), "systematic, of angles");
    v.degrees("drift_sigma_deg", driftSigma, between(0, 10), "systematic turn per metre");
    v.number("distance_sigma_m", distanceSigma, between(0, 1), "random, per square root of metre");
    v.degrees("heading_sigma_deg", headingSigma, between(0, 30),
              "random, per square root of metre");
    v.degrees("turn_sigma_deg", turnSigma, between(0, 30), "random, per square root of radian");
    v.number("slips_per_m", slipsPerMetre, between(0, 10), "how often a wheel slips");
    v.number("slip_sigma_m", slip, between(0, 2), "distance that a slip feigns");
    v.degrees("slip_sigma_deg", slipTurn, between(0, 45), "turn that a slip feigns");
}

double TOdometryOptions::factor() const {
    if (level == EOdometryNoise::low) return 0.3;
    return level == EOdometryNoise::medium ? 1.0 : 4.0;
}

}  // namespace salma::simulator
