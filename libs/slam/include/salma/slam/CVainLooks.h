// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <map>
#include <set>

namespace salma::slam {

/** How often landmarks were looked for in vain.
 *
 * A look counts only from where a landmark was seen before, for a corner may be hidden from
 * elsewhere by what no ray tells, such as the wall that it is the edge of; and only some travel
 * after the one before: what hid it then hides it still. Source: own. */
class CVainLooks {
 public:
    /// \param back From the landmark to the robot, world [m].
    void see(int id, const Eigen::Vector2d& back);

    /** \param travel Of the robot [m]. \param probability Of detection.
     * \return - log probability of having missed the landmark in all looks since it was seen. */
    double miss(int id, const Eigen::Vector2d& back, double travel, double probability);

    void forget(int id) { m_looks.erase(id); }

 private:
    struct TLooks {
        double farthest{0};  //!< Distance from which it was seen [m].
        std::set<int> from;  //!< Directions from it to the robot that saw it, in sectors.
        double inVain{0};    //!< What miss() returns.
        double last{0};      //!< Travel at the last look in vain [m].
    };
    std::map<int, TLooks> m_looks;  //!< By id.
};

}  // namespace salma::slam
