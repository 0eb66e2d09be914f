// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/bayes/CParticleFilter.h>
#include <mrpt/math/wrap2pi.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/poses/CPose3DPDFParticles.h>
#include <mrpt/random/RandomGenerators.h>
#include <salma/slam/CSalientRBPF2D.h>
#include <salma/slam/CSharedParts.h>
#include <salma/slam/rangeBearingModel.h>
#include <salma/slam/registerClasses.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>

#include "CObservationMeasurements.h"
#include "recordRows.h"

namespace salma::slam {

using mrpt::bayes::CParticleFilter;

namespace {

constexpr std::size_t kStepsBetweenCleanings = 50;
constexpr double kOdometryShare = 0.1;  // of the moves, drawn without regard to measurements

/// What keeps the covariance of a robot at rest positive definite.
Eigen::Matrix3d leastMotion() { return Eigen::Vector3d(1e-10, 1e-10, 1e-12).asDiagonal(); }

/// Log density, but for a constant.
double logNormal(const Eigen::Vector3d& pose, const CSalientLandmarkMap::TPoseBelief& belief) {
    Eigen::Vector3d off = pose - belief.mean;
    off[2] = mrpt::math::wrapToPi(off[2]);
    const Eigen::LLT<Eigen::Matrix3d> factor(belief.covariance);
    return -0.5 * factor.matrixL().solve(off).squaredNorm() -
           std::log(factor.matrixLLT().diagonal().prod());
}

CParticleFilter::TParticleFilterOptions filterOptions(const TRbpfOptions& options) {
    CParticleFilter::TParticleFilterOptions result;
    result.PF_algorithm = options.algorithm == EParticleAlgorithm::standard
                              ? CParticleFilter::pfStandardProposal
                          : options.algorithm == EParticleAlgorithm::auxiliary
                              ? CParticleFilter::pfAuxiliaryPFStandard
                              : CParticleFilter::pfAuxiliaryPFOptimal;
    result.resamplingMethod = CParticleFilter::prSystematic;
    result.sampleSize = static_cast<unsigned>(options.particles);
    result.BETA = options.resampleBelow;
    result.pfAuxFilterOptimal_MaximumSearchSamples = static_cast<unsigned>(options.samples);
    result.powFactor = options.weightPower;
    return result;
}

/// Rows (x, y, yaw) of a covariance of (x, y, z, yaw, pitch, roll).
Eigen::Matrix3d planar(const mrpt::math::CMatrixDouble66& covariance) {
    constexpr int kRows[] = {0, 1, 3};
    Eigen::Matrix3d result;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) result(i, j) = covariance(kRows[i], kRows[j]);
    return result;
}

}  // namespace

CSalientRBPF2D::CSalientRBPF2D(const TRbpfOptions& options, const TLandmarkMapSetup& maps)
    : m_options(options) {
    m_options.validate();
    registerClasses();  // copies of maps are read by class name
    // A new one: randomize() would keep half of a pair of normal numbers that was drawn before.
    mrpt::random::getRandomGenerator() =
        mrpt::random::CRandomGenerator(static_cast<std::uint32_t>(options.seed));
    CSalientLandmarkMap::TMapDefinition definition;
    definition.setup = std::make_shared<const CLandmarkMapSetup>(maps);
    mrpt::maps::TSetOfMetricMapInitializers initializers;
    initializers.push_back(definition);
    m_particles = std::make_unique<mrpt::maps::CMultiMetricMapPDF>(
        filterOptions(options), initializers, mrpt::maps::CMultiMetricMapPDF::TPredictionParams());
    m_particles->clear(mrpt::poses::CPose2D());
}

CSalientRBPF2D::~CSalientRBPF2D() = default;

CSalientLandmarkMap& CSalientRBPF2D::mapOf(std::size_t particle) const {
    return dynamic_cast<CSalientLandmarkMap&>(
        *m_particles->m_particles[particle].d->mapTillNow.maps.front());
}

void CSalientRBPF2D::process(const TStepInput& step) {
    checkStep(step);
    refuseWeights();
    move(step);
    refuseWeights();
    m_steps.push_back({step, pose().cov.asEigen()});
    keepDecisions();
    if (m_steps.size() % kStepsBetweenCleanings == 0) forgetDecisions();
}

/// Moves the particles, weighs them by the measurements, and lets each learn.
void CSalientRBPF2D::move(const TStepInput& step) {
    mrpt::obs::CActionRobotMovement2D movement;
    movement.timestamp = mrpt::Clock::fromDouble(step.time);
    movement.estimationMethod = mrpt::obs::CActionRobotMovement2D::emScan2DMatching;
    movement.poseChange = mrpt::poses::CPosePDFGaussian::Create(step.increment);
    mrpt::obs::CActionCollection actions;
    actions.insert(movement);
    mrpt::obs::CSensoryFrame seen;
    if (!step.measurements.empty()) {
        const auto observation = std::make_shared<CObservationMeasurements>();
        observation->timestamp = movement.timestamp;
        observation->measurements = step.measurements;
        for (const auto& m : step.measurements)  // so that the particles can share the patches
            if (m.patch) CSharedParts<observations::TPatch>::instance().numberOf(m.patch);
        seen.insert(observation);
    }
    if (m_options.algorithm == EParticleAlgorithm::measured) {
        moveByMeasurements(step);
    } else {
        CParticleFilter filter;
        filter.setMinLoggingLevel(mrpt::system::LVL_ERROR);
        filter.m_options = filterOptions(m_options);
        filter.executeOn(*m_particles, &actions, &seen);
    }
    if (!step.measurements.empty()) m_particles->insertObservation(seen);
}

/* The proposal of FastSLAM 2.0. Some moves are drawn from odometry alone, so that a wrong
 * association costs samples, not the particle: weights stay below likelihood / kOdometryShare. */
double CSalientRBPF2D::moveOne(std::size_t particle, const TStepInput& step) {
    auto& random = mrpt::random::getRandomGenerator();
    bool known = false;
    const auto last = m_particles->getLastPose(particle, known);
    const auto& increment = step.increment.mean;
    const TMotion motion =
        moved({last.x, last.y, last.yaw}, {increment.x(), increment.y(), increment.phi()});
    const CSalientLandmarkMap& map = mapOf(particle);
    CSalientLandmarkMap::TPoseBelief odometry{motion.pose, leastMotion()};
    odometry.covariance +=
        motion.byIncrement * step.increment.cov.asEigen() * motion.byIncrement.transpose();
    const bool sees = !step.measurements.empty();
    const auto told =
        sees ? map.corrected(step.measurements, odometry, step.time, m_options.weightPower)
             : odometry;
    const bool byOdometry = random.drawUniform(0, 1) < kOdometryShare;
    const auto& from = byOdometry ? odometry : told;
    Eigen::Vector3d unit;
    for (int i = 0; i < 3; ++i) unit[i] = random.drawGaussian1D_normalized();
    const Eigen::Matrix3d root = from.covariance.llt().matrixL();
    Eigen::Vector3d pose = from.mean + root * unit;
    pose[2] = mrpt::math::wrapToPi(pose[2]);
    m_particles->m_particles[particle].d->robotPath.emplace_back(pose[0], pose[1], 0, pose[2], 0,
                                                                 0);
    if (!sees) return 0;
    const double prior = logNormal(pose, odometry);
    const double proposal = std::log(kOdometryShare * std::exp(prior) +
                                     (1 - kOdometryShare) * std::exp(logNormal(pose, told)));
    const double likelihood = map.logLikelihood(
        step.measurements, mrpt::poses::CPose2D(pose[0], pose[1], pose[2]), step.time);
    return m_options.weightPower * likelihood + prior - proposal;
}

void CSalientRBPF2D::moveByMeasurements(const TStepInput& step) {
    auto& particles = m_particles->m_particles;
    for (std::size_t i = 0; i < particles.size(); ++i) particles[i].log_w += moveOne(i, step);
    refuseWeights();
    m_particles->normalizeWeights();
    if (m_particles->ESS() < m_options.resampleBelow)
        m_particles->performResampling(filterOptions(m_options));
}

/// A weight that is no number, or of zero, becomes the smallest of the others.
void CSalientRBPF2D::refuseWeights() {
    double least = std::numeric_limits<double>::infinity();
    for (const auto& particle : m_particles->m_particles)
        if (std::isfinite(particle.log_w)) least = std::min(least, particle.log_w);
    if (!std::isfinite(least)) least = 0;
    for (auto& particle : m_particles->m_particles) {
        if (std::isfinite(particle.log_w)) continue;
        particle.log_w = least;
        ++m_refusedWeights;
    }
}

void CSalientRBPF2D::keepDecisions() {
    if (m_steps.back().input.measurements.empty()) return;
    for (std::size_t i = 0; i < m_particles->m_particles.size(); ++i) {
        CSalientLandmarkMap& map = mapOf(i);
        m_decided[++m_lastKey] = {map.tag, m_steps.size() - 1, map.lastOutcomes()};
        map.tag = m_lastKey;
    }
}

/// Drops what only particles decided that have no descendants.
void CSalientRBPF2D::forgetDecisions() {
    std::set<std::uint64_t> needed;
    for (std::size_t i = 0; i < m_particles->m_particles.size(); ++i)
        for (auto key = mapOf(i).tag; key != 0 && needed.insert(key).second;)
            key = m_decided.at(key).before;
    for (auto i = m_decided.begin(); i != m_decided.end();)
        i = needed.count(i->first) == 0 ? m_decided.erase(i) : std::next(i);
}

std::size_t CSalientRBPF2D::best() const {
    std::size_t result = 0;
    for (std::size_t i = 1; i < m_particles->m_particles.size(); ++i)
        if (m_particles->m_particles[i].log_w > m_particles->m_particles[result].log_w) result = i;
    return result;
}

mrpt::poses::CPosePDFGaussian CSalientRBPF2D::pose() const {
    mrpt::poses::CPose3DPDFParticles all;
    m_particles->getEstimatedPosePDF(all);
    const auto [covariance, mean] = all.getCovarianceAndMean();
    return {mrpt::poses::CPose2D(mean), mrpt::math::CMatrixDouble33(planar(covariance))};
}

void CSalientRBPF2D::results(TRunRecord& record) const {
    record.trajectory.clear();
    record.landmarks.clear();
    record.associations.clear();
    record.candidates.clear();
    record.innovations.clear();
    if (m_refusedWeights > 0) record.refused["weights of particles, no number"] = m_refusedWeights;
    const std::size_t particle = best();
    const CSalientLandmarkMap& map = mapOf(particle);
    noteTrajectory(particle, record);
    noteLandmarks(map, record);
    std::vector<std::uint64_t> keys;
    for (auto key = map.tag; key != 0; key = m_decided.at(key).before) keys.push_back(key);
    std::for_each(keys.rbegin(), keys.rend(),
                  [&](auto key) { noteDecisions(m_decided.at(key), record); });
}

void CSalientRBPF2D::noteTrajectory(std::size_t particle, TRunRecord& record) const {
    std::deque<mrpt::math::TPose3D> path;
    m_particles->getPath(particle, path);
    for (std::size_t k = 0; k < m_steps.size(); ++k) {
        TTrajectoryRow row;
        row.time = m_steps[k].input.time;
        // 0: the start
        row.pose = row.running = mrpt::poses::CPose2D(mrpt::poses::CPose3D(path.at(k + 1)));
        row.covariance = m_steps[k].covariance;
        row.odometry = m_steps[k].input.odometry;
        record.trajectory.push_back(row);
    }
}

void CSalientRBPF2D::noteLandmarks(const CSalientLandmarkMap& map, TRunRecord& record) const {
    for (std::size_t k = 0; k < map.size(); ++k) {
        if (!map.isConfirmed(k)) continue;
        TMapLandmark landmark = mapLandmarkOf(map.landmark(k));
        landmark.mean = {map.place(k).mean[0], map.place(k).mean[1]};
        landmark.covariance = map.place(k).covariance;
        record.landmarks.push_back(landmark);
    }
}

void CSalientRBPF2D::noteDecisions(const TDecided& decided, TRunRecord& record) const {
    const TStep& step = m_steps[decided.step];
    auto& sight = record.trajectory[decided.step].sight;
    for (std::size_t i = 0; i < decided.outcomes.measurements.size(); ++i) {
        const auto& outcome = decided.outcomes.measurements[i];
        const EDecision decision =
            outcome.provisional ? EDecision::provisional : decisionOf(outcome.decision.verdict);
        record.associations.push_back(
            associationRow(step.input, i, decision, outcome.decision, outcome.decision.landmark));
        if (decision == EDecision::created && sight == ESight::nothing) sight = ESight::first;
        if (outcome.decision.verdict != association::EVerdict::paired) continue;
        if (decision == EDecision::paired) sight = ESight::again;
        addInnovation(step.input.time, outcome.innovation, outcome.sigma, record.innovations);
    }
    for (const auto& candidate : decided.outcomes.candidates)
        record.candidates.push_back({step.input.time, candidate.observation,
                                     static_cast<int>(candidate.landmark), candidate.distance2,
                                     candidate.logRatio, candidate.chosen, candidate.inGate});
}

}  // namespace salma::slam
