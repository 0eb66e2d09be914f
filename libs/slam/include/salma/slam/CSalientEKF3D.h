// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/slam/CRangeBearingKFSLAM.h>
#include <salma/association/CDataAssociator.h>
#include <salma/slam/CLandmarkTable.h>
#include <salma/slam/CSlamBackend.h>
#include <salma/slam/TEkfOptions.h>

#include <memory>
#include <optional>

namespace salma::slam {

/** MRPT's EKF-SLAM in space with salma's data association.
 *
 * State, models and step are MRPT's: position, quaternion and 3-D landmarks; one noise covariance
 * R, the mean of the step's, for all measurements. Two things are not: the association, and that
 * odometry counts from the first step, also while there is no landmark yet. Landmarks have no
 * appearance (kind corner) and enter the map at their first sighting: there is no tracker for
 * provisional ones in space. */
class CSalientEKF3D : public mrpt::slam::CRangeBearingKFSLAM, public CSlamBackend {
 public:
    /// \throw std::invalid_argument if options are out of range.
    CSalientEKF3D(const TEkfOptions& ekf, const association::TAssociationOptions& association);
    ~CSalientEKF3D() override;

    /// Uses `step.spatial` and no other measurements.
    /// \throw std::invalid_argument if it is missing or not finite.
    void process(const TStepInput& step) override;

    /// As seen from above.
    mrpt::poses::CPosePDFGaussian pose() const override;
    mrpt::poses::CPose3DPDFGaussian spatialPose() const;
    void results(TRunRecord& record) const override;

 protected:
    void OnTransitionModel(const KFArray_ACT& u, KFArray_VEH& pose, bool& skip) const override;
    void OnGetObservationNoise(KFMatrix_OxO& R) const override;
    void OnPreComputingPredictions(const vector_KFArray_OBS& means,
                                   std::vector<size_t>& indices) const override;
    void OnGetObservationsAndDataAssociation(vector_KFArray_OBS& z,
                                             std::vector<int>& pairings,
                                             const vector_KFArray_OBS& predictions,
                                             const KFMatrix& S,
                                             const std::vector<size_t>& indicesInS,
                                             const KFMatrix_OxO& R) override;
    void OnNewLandmarkAddedToMap(const size_t row, const size_t index) override;

 private:
    /// What the current step has come to so far.
    struct TCurrentStep {
        TStepInput input;  //!< Its flat measurements are those of `spatial` without their pitch.
        std::optional<association::TAssociation> association;  //!< Made once, after prediction.
        std::vector<int> landmarks;                 //!< By measurement, index in the state; -1.
        std::vector<std::size_t> rowToObservation;  //!< Of MRPT's list of measurements.
    };

    // A caller of MRPT's own entry point would go past the association and the record.
    using CRangeBearingKFSLAM::processActionObservation;

    const std::vector<association::TMeasurement3D>& measurements() const;
    void associate(const vector_KFArray_OBS& predictions,
                   const KFMatrix& S,
                   const std::vector<size_t>& indicesInS,
                   const KFMatrix_OxO& R);
    void noteInnovations(const association::TAssociationProblem3D& problem);
    void learn();
    void noteStep();

    TEkfOptions m_ekf;
    std::unique_ptr<association::CDataAssociator> m_associator;
    CLandmarkTable m_landmarks;
    TCurrentStep m_now;
    TRunRecord m_record;  //!< Rows of all steps; landmarks only in results().
};

}  // namespace salma::slam
