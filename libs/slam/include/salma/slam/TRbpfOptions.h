// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>

#include <cmath>

namespace salma::slam {

/// How particles are moved and weighed; the names of MRPT's algorithms.
enum class EParticleAlgorithm {
    standard,          //!< Move by odometry, then weigh (pfStandardProposal).
    auxiliary,         //!< Weigh where odometry leads, then move (pfAuxiliaryPFStandard).
    auxiliaryOptimal,  //!< Choose the best of many moves (pfAuxiliaryPFOptimal).
    measured,          //!< Move to where odometry and measurements lead (FastSLAM 2.0); own.
};

/// Section [rbpf] of config.ini.
struct TRbpfOptions : public config::TStrictOptions<TRbpfOptions> {
    EParticleAlgorithm algorithm{EParticleAlgorithm::standard};
    int particles{100};
    double resampleBelow{0.5};  //!< Effective share of the particles.
    int samples{20};            //!< Moves that are tried for a particle (auxiliary).
    double weightPower{0.3};    //!< Exponent of the likelihood.
    /// A particle's heading is a sample: walls are compared with this uncertainty of it [rad].
    double headingSigma{M_PI / 180};
    int seed{1};

    void visit(config::COptionVisitor& v);
};

}  // namespace salma::slam
