// SPDX-License-Identifier: BSD-3-Clause
#include <salma/slam/TRbpfOptions.h>

namespace salma::slam {

void TRbpfOptions::visit(config::COptionVisitor& v) {
    v.choice("algorithm", algorithm,
             {{"standard", EParticleAlgorithm::standard},
              {"auxiliary", EParticleAlgorithm::auxiliary},
              {"auxiliary_optimal", EParticleAlgorithm::auxiliaryOptimal},
              {"measured", EParticleAlgorithm::measured}},
             "how particles are moved and weighed");
    v.integer("particles", particles, config::between(1, 100000), "number of particles");
    v.number("resample_below", resampleBelow, config::between(0, 1),
             "particles are drawn anew if a smaller share of them is effective");
    v.integer("samples", samples, config::between(1, 10000),
              "moves that are tried for a particle (auxiliary, auxiliary_optimal)");
    v.number("weight_power", weightPower, {0, 1, true},
             "exponent of the likelihood; below 1 it trusts single steps less");
    v.degrees("heading_sigma_deg", headingSigma, config::between(0, 45),
              "uncertainty of a particle's heading where directions of walls are compared");
    v.integer("seed", seed, config::atLeast(0), "of the random numbers");
}

}  // namespace salma::slam
