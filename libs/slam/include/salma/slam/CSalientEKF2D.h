// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/slam/CRangeBearingKFSLAM2D.h>
#include <salma/association/CDataAssociator.h>
#include <salma/slam/CSlamBackend.h>
#include <salma/slam/TEkfOptions.h>

#include <functional>
#include <memory>

namespace salma::slam {

/// Log likelihood ratio same/other of a seen patch and a stored one; NaN: cannot tell.
using PatchRatio =
    std::function<double(const observations::TPatch& seen, const observations::TPatch& stored)>;

/** EKF-SLAM of posters and corners on the state of MRPT's range-bearing filter.
 *
 * State, ids, views and saved files are MRPT's: pose (x, y, heading) and 2-D landmarks. */
class CSalientEKF2D : public mrpt::slam::CRangeBearingKFSLAM2D, public CSlamBackend {
 public:
    /** \param ratio Null: appearance is not used.
     * \throw std::invalid_argument if options are out of range. */
    CSalientEKF2D(const TEkfOptions& options,
                  const association::TAssociationOptions& association,
                  PatchRatio ratio = nullptr);
    ~CSalientEKF2D() override;

    void process(const TStepInput& step) override;
    mrpt::poses::CPosePDFGaussian pose() const override;
    void results(TRunRecord& record) const override;
};

}  // namespace salma::slam
