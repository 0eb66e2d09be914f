// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/slam/CRangeBearingKFSLAM2D.h>
#include <salma/association/CDataAssociator.h>
#include <salma/landmarks/CWideBaselineTracker.h>
#include <salma/slam/CLandmarkTable.h>
#include <salma/slam/CPathHistory.h>
#include <salma/slam/CPathSmoother.h>
#include <salma/slam/CRelocator.h>
#include <salma/slam/CSlamBackend.h>
#include <salma/slam/CStepEvidence.h>
#include <salma/slam/CVainLooks.h>
#include <salma/slam/TEkfOptions.h>
#include <salma/slam/TSlipOptions.h>
#include <salma/slam/blockFilter.h>

#include <map>
#include <memory>
#include <optional>

namespace salma::slam {

/// What keeps a map sound beside the filter's steps.
struct TMapCare {
    TDetectionOptions detection;
    TRelocationOptions relocation;
    TSlipOptions slip;
};

/** EKF-SLAM of posters and corners on the state of MRPT's range-bearing filter.
 *
 * State, ids, views and saved files are MRPT's: pose (x, y, heading) and 2-D landmarks; the ids of
 * MRPT are those of the record. Odometry counts from the first step, also while there is no
 * landmark yet (MRPT's own class ignores it then). Measurements are in the robot frame. */
class CSalientEKF2D : public mrpt::slam::CRangeBearingKFSLAM2D, public CSlamBackend {
 public:
    /** \param ratio Null: appearance is not used.
     * \param tracking When an entity becomes a landmark; by default at its first sighting.
     * \throw std::invalid_argument if options are out of range. */
    CSalientEKF2D(const TEkfOptions& ekf,
                  const association::TAssociationOptions& association,
                  PatchRatio ratio = nullptr,
                  const landmarks::TTrackingOptions& tracking = atFirstSight(),
                  const TMapCare& care = {});
    ~CSalientEKF2D() override;

    static landmarks::TTrackingOptions atFirstSight();

    void process(const TStepInput& step) override;
    mrpt::poses::CPosePDFGaussian pose() const override;
    TStepMotion motion() const override { return m_now.motion; }
    void results(TRunRecord& record) const override;
    void finish() override;

    const CLandmarkTable& landmarks() const { return m_landmarks; }
    /// Pairs that the tests of the association excluded, over all steps.
    const association::TDropCounts& dropped() const { return m_dropped; }

 protected:
    // Hooks of MRPT's step, for `update = mrpt` only.
    void OnTransitionModel(const KFArray_ACT& u, KFArray_VEH& pose, bool& skip) const override;
    void OnObservationJacobians(size_t index, KFMatrix_OxV& Hx, KFMatrix_OxF& Hy) const override;
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
    /// What a step's measurements show, given one prediction.
    struct TJudgement {
        std::vector<double> sigmas;               //!< By landmark, how vaguely predicted [m].
        std::unique_ptr<CStepEvidence> evidence;  //!< None without appearance.
        association::TAssociationProblem problem;
        association::TAssociation association;
    };
    /// What the current step has come to so far.
    struct TCurrentStep {
        TStepInput input;
        std::optional<TJudgement> judgement;  //!< Made once, after prediction.
        std::vector<EDecision> decisions;     //!< By measurement.
        std::vector<int> landmarks;           //!< By measurement, index in the state; -1: none.
        std::vector<bool> confirms;  //!< By measurement: the last view that a landmark needed.
        std::vector<std::size_t> rowToObservation;  //!< Of MRPT's list of measurements.
        TStepMotion motion;
        bool closesLoop{false};  //!< Landmarks not seen for long were paired.
    };

    // A caller of MRPT's own entry point would go past the association and the record.
    using CRangeBearingKFSLAM2D::processActionObservation;

    void stepByBlock();
    void stepByMrpt();
    void associate();
    TJudgement judged() const;
    bool suspectsSlip(const TJudgement& judgement) const;
    std::vector<bool> tracked() const;
    void considerSlip();
    void holdBackCorners();
    void holdBackEntities();
    bool sees(association::ELandmarkKind kind) const;
    EDecision told(std::size_t observation) const;
    landmarks::TSighting sightingOf(const association::TMeasurement& measurement) const;
    void enterLandmark(std::size_t observation, std::size_t index);
    bool tracksLandmarks() const;
    void learn();
    Eigen::Matrix3d poseCovariance() const;
    void smooth();
    void anchor();
    bool keepsHistory() const;
    void remember();
    void noteUse();
    void removeAbsent();
    bool knowsPlace() const;
    bool isMissing(std::size_t landmark) const;
    void remove(std::size_t landmark);
    double largestSigma(std::size_t landmark, bool hasPoster) const;
    void relocate();
    bool isWorthAJoin(const TAlignment& alignment) const;
    bool extend(TAlignment& alignment);
    bool join(TRelocation& found);
    void refuse(const TRelocation& found);
    void noteRelocation(const std::string& outcome, const TRelocation& found);
    void setState(const TSmoothed& smoothed);
    void noteAssociation();
    void noteDecisions();
    void notePose();
    THeading heading() const;
    Eigen::Vector3d poseMean() const;
    TFilterState state();

    TEkfOptions m_ekf;
    std::unique_ptr<association::CDataAssociator> m_associator;
    PatchRatio m_ratio;
    TEvidenceLimits m_evidenceLimits;
    CLandmarkTable m_landmarks;
    landmarks::CWideBaselineTracker m_provisionalCorners, m_provisionalEntities;
    association::TDropCounts m_dropped;
    TMapCare m_care;
    CDetectionModel m_detection;
    /// Methods that never defer, and MRPT's step, which has one covariance for all measurements,
    /// stay as they are.
    bool m_relocates, m_explainsSlips;
    CPathHistory m_history;
    std::map<int, double> m_lastUsed;  //!< By id, travel when a landmark was last used [m].
    bool m_knowsPlace{false};          //!< At the last scan.
    CVainLooks m_looks;
    CRelocator m_relocator;
    double m_lastAttempt{0};          //!< Travel at it [m].
    double m_lastSmoothing{0};        //!< Likewise [m].
    Eigen::Vector3d m_base{0, 0, 0};  //!< Pose from which the covariance is stated.
    Eigen::Matrix3d m_baseCovariance{Eigen::Matrix3d::Zero()};  //!< Of it, in the world.
    TCurrentStep m_now;
    TRunRecord m_record;  //!< Rows of all steps; landmarks only in results().
};

}  // namespace salma::slam
