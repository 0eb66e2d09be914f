// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CMultiMetricMapPDF.h>
#include <salma/slam/CSalientLandmarkMap.h>
#include <salma/slam/CSlamBackend.h>
#include <salma/slam/TRbpfOptions.h>

#include <map>
#include <memory>

namespace salma::slam {

/** Rao-Blackwellised SLAM with MRPT's particle filter: each particle is a path and a
 * CSalientLandmarkMap of its own, which associates for itself. With `algorithm = measured` the
 * particles are moved here, by odometry and measurements together (FastSLAM 2.0).
 *
 * The record holds path, map and associations of the particle that weighs most at the end; the
 * covariance of a pose is that of all particles at the time. The random numbers are those of
 * MRPT's global generator, which the constructor seeds: one filter at a time. */
class CSalientRBPF2D : public CSlamBackend {
 public:
    /// \throw std::invalid_argument if options are out of range.
    CSalientRBPF2D(const TRbpfOptions& options, const TLandmarkMapSetup& maps);
    ~CSalientRBPF2D() override;

    void process(const TStepInput& step) override;
    mrpt::poses::CPosePDFGaussian pose() const override;
    void results(TRunRecord& record) const override;

    const mrpt::maps::CMultiMetricMapPDF& particles() const { return *m_particles; }
    /// Times that a particle's weight was zero or no number.
    std::size_t refusedWeights() const { return m_refusedWeights; }

 private:
    /// What a particle decided in a step; the particles that descend from it share it.
    struct TDecided {
        std::uint64_t before{0};  //!< Its key in m_decided, 0 for none.
        std::size_t step{0};
        CSalientLandmarkMap::TOutcomes outcomes;
    };
    /// A step as the log has it.
    struct TStep {
        TStepInput input;
        Eigen::Matrix3d covariance{Eigen::Matrix3d::Zero()};
    };

    void move(const TStepInput& step);
    void moveByMeasurements(const TStepInput& step);
    void refuseWeights();
    double moveOne(std::size_t particle, const TStepInput& step);
    void keepDecisions();
    void forgetDecisions();
    std::size_t best() const;
    CSalientLandmarkMap& mapOf(std::size_t particle) const;
    void noteTrajectory(std::size_t particle, TRunRecord& record) const;
    void noteLandmarks(const CSalientLandmarkMap& map, TRunRecord& record) const;
    void noteDecisions(const TDecided& decided, TRunRecord& record) const;

    TRbpfOptions m_options;
    std::unique_ptr<mrpt::maps::CMultiMetricMapPDF> m_particles;
    std::vector<TStep> m_steps;
    std::map<std::uint64_t, TDecided> m_decided;
    std::uint64_t m_lastKey{0};
    std::size_t m_refusedWeights{0};
};

}  // namespace salma::slam
