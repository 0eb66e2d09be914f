// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace salma::slam {

/** Corners that wait to be seen again before the filter takes them, so that what the laser takes
 * for a corner once does not stay in the map. They never touch the filter: a corner that is
 * confirmed starts from its last sighting alone, so no measurement counts twice. */
class CProvisionalCorners {
 public:
    /** \param sightings Steps in which a corner must be seen, this one included.
     * \param radius Sightings of one corner lie within it [m].
     * \param memory Steps after which an unseen corner is forgotten. */
    CProvisionalCorners(int sightings, double radius, int memory);

    /// Call once per step with corners, before confirms().
    void beginStep();

    /// \param position Where the current estimate sees the corner, world [m].
    /// \return True if that was the last sighting it needed; it is then forgotten here.
    bool confirms(const Eigen::Vector2d& position, bool convex);

    std::size_t size() const { return m_corners.size(); }

 private:
    struct TCorner {
        Eigen::Vector2d position;
        bool convex;
        int sightings;
        int lastStep;
    };

    int m_sightings;
    double m_radius;
    int m_memory;
    int m_step{0};
    std::vector<TCorner> m_corners;
};

}  // namespace salma::slam
