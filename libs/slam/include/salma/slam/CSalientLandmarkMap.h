// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/maps/CMetricMap.h>
#include <mrpt/maps/TMetricMapInitializer.h>
#include <mrpt/maps/TMetricMapTypesRegistry.h>
#include <salma/slam/CLandmarkMapSetup.h>
#include <salma/slam/CLandmarkTable.h>
#include <salma/slam/CStepEvidence.h>

#include <memory>
#include <vector>

namespace salma::slam {

/** Landmarks seen from exactly known poses: the map of one particle of a Rao-Blackwellised filter.
 *
 * It takes salient landmarks (CObservationSalientLandmarks) and range-bearing records
 * (CObservationBearingRange). Each insertion associates for itself, by geometry and appearance; a
 * landmark is a Gaussian in the plane, independent of all others given the path (Montemerlo et al.,
 * FastSLAM, AAAI 2002). A corner counts from its `min_sightings_corner`-th sighting on, and is
 * forgotten if that does not come within `provisional_steps` insertions.
 *
 * The log likelihood of a measurement z from a pose is
 *   log( lambda + sum over landmarks P_D LR N(z; predicted, S) ),
 * LR the likelihood ratio of the appearance (1 without), lambda the density of landmarks that are
 * not in the map: no measurement is forced onto a landmark, and none counts less than a new one.
 * Appearance counts once per track and landmark (CStepEvidence), here and in the association.
 *
 * Copies share the patches and the options (CSharedParts): MRPT copies maps through a memory
 * stream, which then holds geometry and numbers only and can be read as long as the map that wrote
 * it has those patches. In every other stream the map is complete. */
class CSalientLandmarkMap : public mrpt::maps::CMetricMap {
    DEFINE_SERIALIZABLE(CSalientLandmarkMap, salma::slam)

 public:
    CSalientLandmarkMap();
    explicit CSalientLandmarkMap(std::shared_ptr<const CLandmarkMapSetup> setup);

    /// A landmark's place given the path [m].
    struct TPlace {
        Eigen::Vector2d mean{0, 0};
        Eigen::Matrix2d covariance{Eigen::Matrix2d::Identity()};
        std::size_t born{0};  //!< Number of the insertion that made it.
    };

    std::size_t size() const { return m_places.size(); }
    const TPlace& place(std::size_t index) const { return m_places[index]; }
    const TLandmark& landmark(std::size_t index) const { return m_table[index]; }
    /// False for a corner that was not yet seen often enough.
    bool isConfirmed(std::size_t index) const;

    /// Log likelihood of measurements (robot frame) from a pose; those that are not finite or whose
    /// covariance is not positive definite do not count. \param time [s since 1970]
    double logLikelihood(const std::vector<association::TMeasurement>& measurements,
                         const mrpt::poses::CPose2D& pose,
                         double time) const;

    /// A pose that is not known exactly.
    struct TPoseBelief {
        Eigen::Vector3d mean{0, 0, 0};  //!< (x, y, heading) [m, rad]
        Eigen::Matrix3d covariance{Eigen::Matrix3d::Zero()};
    };

    /** Where motion and measurements together say that the robot is: the proposal of FastSLAM 2.0.
     *
     * The measurements are associated with confirmed landmarks given how sure the motion is; what
     * is paired corrects it, linearised anew at each of a few iterations.
     * \param predicted By the motion alone; its covariance must be positive definite.
     * \param power Exponent of the likelihood: measurements count as if R and the landmarks'
     * covariances were larger by its inverse.
     * \return `predicted` where nothing is paired or the result is not finite.
     * Source: Montemerlo, Thrun, Koller, Wegbreit, FastSLAM 2.0, IJCAI 2003, eqs. 9 to 12. */
    TPoseBelief corrected(const std::vector<association::TMeasurement>& measurements,
                          const TPoseBelief& predicted,
                          double time,
                          double power) const;

    /// Associates the measurements and learns from them. \param time [s since 1970]
    void learn(const std::vector<association::TMeasurement>& measurements,
               const mrpt::poses::CPose2D& pose,
               double time);

    /// What became of a measurement.
    struct TOutcome {
        association::TDecision decision;   //!< Its landmark is the id, -1 for none.
        bool provisional{false};           //!< The landmark is not confirmed yet.
        Eigen::Vector2d innovation{0, 0};  //!< Range [m] and bearing [rad], if it was paired.
        Eigen::Vector2d sigma{0, 0};       //!< Of the innovation.
    };

    /// What became of the measurements of an insertion.
    struct TOutcomes {
        std::vector<TOutcome> measurements;
        std::vector<association::TCandidate> candidates;  //!< Their landmarks are ids.
    };

    /// Of the last call of learn(); copies have none.
    const TOutcomes& lastOutcomes() const { return m_outcomes; }

    std::uint64_t tag{0};  //!< For the owner; copies and files keep it.

    bool isEmpty() const override { return m_places.empty(); }
    std::string asString() const override;
    void getVisualizationInto(mrpt::opengl::CSetOfObjects& objects) const override;
    /// Writes PREFIX_landmarks.csv: id,kind,x_m,y_m,sigma_x_m,sigma_y_m,sightings.
    /// \throw std::runtime_error if it cannot.
    void saveMetricMapRepresentationToFile(const std::string& prefix) const override;

    MAP_DEFINITION_START(CSalientLandmarkMap)
    std::shared_ptr<const salma::slam::CLandmarkMapSetup> setup;  //!< Shared by all maps made.
    MAP_DEFINITION_END(CSalientLandmarkMap)

 private:
    void internal_clear() override;
    bool internal_insertObservation(
        const mrpt::obs::CObservation& observation,
        const std::optional<const mrpt::poses::CPose3D>& robotPose) override;
    double internal_computeObservationLikelihood(
        const mrpt::obs::CObservation& observation,
        const mrpt::poses::CPose3D& takenFrom) const override;
    bool internal_canComputeObservationLikelihood(
        const mrpt::obs::CObservation& observation) const override;

    std::vector<std::size_t> near(const std::vector<association::TMeasurement>& measurements,
                                  const TPoseBelief& pose) const;
    /// The problem points to no other object; it has no ratios.
    association::TAssociationProblem problem(
        const std::vector<association::TMeasurement>& measurements,
        const std::vector<std::size_t>& landmarks,
        const TPoseBelief& pose) const;
    std::unique_ptr<CStepEvidence> evidenceOf(const association::TAssociationProblem& problem,
                                              const std::vector<std::size_t>& landmarks,
                                              double time) const;
    double density(const association::TAssociationProblem& problem,
                   const std::vector<std::size_t>& landmarks,
                   std::size_t observation,
                   CStepEvidence* evidence) const;
    void update(std::size_t index,
                const association::TMeasurement& measurement,
                const Eigen::Vector3d& pose,
                TOutcome& outcome);
    std::size_t enter(const association::TMeasurement& measurement,
                      const Eigen::Vector3d& pose,
                      double time);
    void forgetProvisional();

    std::shared_ptr<const CLandmarkMapSetup> m_setup;
    PatchRatio m_ratio;  //!< Of the setup.
    CLandmarkTable m_table;
    std::vector<TPlace> m_places;  //!< In the order of the table.
    std::size_t m_insertions{0};
    TOutcomes m_outcomes;
};

}  // namespace salma::slam
