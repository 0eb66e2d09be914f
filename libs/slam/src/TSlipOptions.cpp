// SPDX-License-Identifier: BSD-3-Clause
#include <salma/slam/TSlipOptions.h>

namespace salma::slam {

void TSlipOptions::visit(config::COptionVisitor& v) {
    v.flag("use", use, "explain a step by a slip of the wheels where odometry cannot (saliency)");
    v.number("per_metre", perMetre, config::moreThan(0), "slips per metre of travel");
    v.number("along_m", along, config::moreThan(0), "sigma of the distance that a slip feigns");
    v.degrees("turn_deg", turn, config::moreThan(0), "sigma of the turn that a slip feigns");
}

}  // namespace salma::slam
