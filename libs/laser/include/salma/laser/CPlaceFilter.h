// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/config/TStrictOptions.h>
#include <salma/laser/EPlaceClass.h>

#include <array>

namespace salma::laser {

/// Row: class now; column: class a step later. Every row has sum 1.
using TPlaceMatrix = std::array<TPlaceVector, kPlaceClasses>;

/// A robot that turns sees another place sooner than one that goes on.
struct TPlaceTransitions {
    TPlaceMatrix goingOn;
    TPlaceMatrix turning;
};

/// As counted on walks of 0.2 m or 15 deg a step through the training buildings.
TPlaceTransitions shippedPlaceTransitions();

enum class EPlaceStep { goingOn, turning };

struct TPlaceFilterOptions : public config::TStrictOptions<TPlaceFilterOptions> {
    /// Exponent of a scan's probabilities: neighbouring scans err alike, so each counts for less
    /// than a new piece of evidence.
    double evidence{1};
    /// Probability that what comes next has nothing to do with what was.
    double surprise{0.3};

    void visit(config::COptionVisitor& v);
};

/** The kind of place over time: a Bayes filter over the classes, one step for each scan.
 * Before the first scan all classes are equally likely. */
class CPlaceFilter {
 public:
    /// \throw std::invalid_argument if an option is out of range or a row is no distribution.
    explicit CPlaceFilter(const TPlaceFilterOptions& options = {},
                          const TPlaceTransitions& transitions = shippedPlaceTransitions());

    /** \param scan Probabilities from one scan, for classes that are equally likely before.
     * \param step How the robot moved since the last scan: some 0.2 m, or some 15 deg.
     * \return Probabilities given all scans so far.
     * \throw std::invalid_argument if a number is negative or not finite, or all are zero. */
    const TPlaceVector& update(const TPlaceVector& scan, EPlaceStep step = EPlaceStep::goingOn);

    /// A step without a scan that can be judged.
    const TPlaceVector& skip(EPlaceStep step = EPlaceStep::goingOn);

    const TPlaceVector& belief() const { return m_belief; }

 private:
    void predict(EPlaceStep step);

    TPlaceFilterOptions m_options;
    TPlaceTransitions m_transitions;
    TPlaceVector m_belief{};
};

}  // namespace salma::laser
