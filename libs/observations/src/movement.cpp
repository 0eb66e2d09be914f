// SPDX-License-Identifier: BSD-3-Clause
#include "movement.h"

#include <mrpt/math/wrap2pi.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CActionRobotMovement3D.h>
#include <mrpt/poses/CPosePDFParticles.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstring>
#include <stdexcept>

using mrpt::obs::CActionRobotMovement2D;
using mrpt::obs::CActionRobotMovement3D;
using mrpt::poses::CPosePDFGaussian;

namespace salma::observations {
namespace {

void refuseEmpty(const mrpt::obs::CActionCollection& actions) {
    for (const auto& entry : actions) {
        const auto action = entry.get_ptr();
        const auto movement = std::dynamic_pointer_cast<CActionRobotMovement2D>(action);
        if (!action || (movement && !movement->poseChange.get_ptr()))
            throw std::runtime_error("holds an empty action");
    }
}

/// A file may hold any number where an enumeration belongs, and to load one as such is undefined.
bool isOdometry(const CActionRobotMovement2D& action) {
    int method = 0;
    static_assert(sizeof method == sizeof action.estimationMethod);
    std::memcpy(&method, &action.estimationMethod, sizeof method);
    return method == CActionRobotMovement2D::emOdometry;
}

CPosePDFGaussian fromThrunModel(const CActionRobotMovement2D& action) {
    const auto& model = action.motionModelConfiguration.thrunModel;
    const mrpt::poses::CPose2D& step = action.rawOdometryIncrementReading;
    const double length = step.norm();
    const double turn1 = length > 0 ? std::atan2(step.y(), step.x()) : 0;
    const double turn2 = mrpt::math::wrapToPi(step.phi() - turn1);
    const double sigma1 = model.alfa1_rot_rot * std::abs(turn1) + model.alfa2_rot_trans * length;
    const double sigma2 = model.alfa1_rot_rot * std::abs(turn2) + model.alfa2_rot_trans * length;
    const double sigmaLength = model.alfa3_trans_trans * length +
                               model.alfa4_trans_rot * (std::abs(turn1) + std::abs(turn2));
    // Derivatives of (x, y, phi) by (turn1, length, turn2).
    Eigen::Matrix3d J;
    J << -length * std::sin(turn1), std::cos(turn1), 0,  //
        length * std::cos(turn1), std::sin(turn1), 0,    //
        1, 0, 1;
    const Eigen::Vector3d sigmas(sigma1, sigmaLength, sigma2);
    Eigen::Matrix3d covariance = J * sigmas.cwiseAbs2().asDiagonal() * J.transpose();
    const double xy = model.additional_std_XY;
    const double phi = model.additional_std_phi;
    covariance.diagonal() += Eigen::Vector3d(xy * xy, xy * xy, phi * phi);
    CPosePDFGaussian movement;
    movement.mean = step;
    movement.cov = covariance;
    return movement;
}

}  // namespace

TMovement& TMovement::operator+=(const TMovement& next) {
    flat += next.flat;
    if (spatial && next.spatial)
        *spatial += *next.spatial;
    else
        spatial.reset();
    return *this;
}

std::optional<TMovement> movementOf(const mrpt::obs::CActionCollection& actions) {
    refuseEmpty(actions);
    TMovement movement;
    if (const auto flat = actions.getBestMovementEstimation()) {
        const bool redrawn = std::dynamic_pointer_cast<mrpt::poses::CPosePDFParticles>(
                                 flat->poseChange.get_ptr()) != nullptr;
        if (redrawn && isOdometry(*flat))
            movement.flat = fromThrunModel(*flat);
        else
            movement.flat.copyFrom(*flat->poseChange);
        return movement;
    }
    const auto spatial = actions.getActionByClass<CActionRobotMovement3D>();
    if (!spatial) return std::nullopt;
    movement.flat.copyFrom(spatial->poseChange);
    movement.spatial = spatial->poseChange;
    return movement;
}

}  // namespace salma::observations
