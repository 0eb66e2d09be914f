// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/math/TPoint2D.h>
#include <salma/observations/TPatch.h>

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

namespace salma::landmarks {

/// A landmark of a finished map, as the database keeps it.
struct TStoredLandmark {
    int id{0};
    std::string kind;                                     //!< "salient" or "corner".
    mrpt::math::TPoint2D mean;                            //!< World [m].
    Eigen::Matrix2d covariance{Eigen::Matrix2d::Zero()};  //!< Of (x, y) [m^2].
    int sightings{0};
    double firstTime{0}, lastTime{0};                   //!< [s since 1970]
    std::shared_ptr<const observations::TPatch> patch;  //!< Null for a landmark without appearance.
};

/** A map's landmarks in an SQLite file, `landmarks.db`.
 *
 * Table `landmark` holds a row per landmark in readable columns; table `patch` what it looks like,
 * as a serialised CObservationSalientLandmarks with that one patch, so that old databases stay
 * readable with the records. The file's `user_version` is the version of this layout. */
class CLandmarkDatabase {
 public:
    explicit CLandmarkDatabase(std::string file);

    /** Makes the file anew with these landmarks, in one transaction: a crash leaves either nothing
     * or all. \throw std::runtime_error naming the file, also if it exists already. */
    void create(const std::vector<TStoredLandmark>& landmarks) const;

    /// All landmarks, by id. \throw std::runtime_error naming the file if it is missing, no
    /// database, of another version or damaged.
    std::vector<TStoredLandmark> read() const;

 private:
    std::string m_file;
};

}  // namespace salma::landmarks
