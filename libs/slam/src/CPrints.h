// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <map>
#include <vector>

namespace salma::slam {

/** Posters of two maps that may be prints of one picture.
 *
 * Signs hang where a building's plan puts them: that they fall together in an alignment says of two
 * places no more than that they are built alike, as corners do. */
class CPrints {
 public:
    struct TPoster {
        std::size_t index{0};         //!< In the table of landmarks.
        Eigen::Vector2d place{0, 0};  //!< In the frame of its own map [m].
    };

    /** \param across One of either map: they may be the same thing.
     * \param logRatio Of their appearance; NaN: cannot tell. */
    void add(const TPoster& a, const TPoster& b, bool across, double logRatio);

    /** Whether the building probably has more of a poster.
     *
     * \param T Brings places of the other map into the frame of the poster's own. */
    bool repeats(const TPoster& poster, const Eigen::Vector3d& T) const;

 private:
    struct TOther {
        Eigen::Vector2d place{0, 0};
        bool across{false};
        double odds{0};  //!< That both show one picture.
    };
    std::map<std::size_t, std::vector<TOther>> m_others;  //!< By index.
};

}  // namespace salma::slam
