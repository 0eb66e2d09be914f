// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/Clock.h>
#include <salma/observations/CPanTiltHistory.h>

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>

#include "interpolation.h"

namespace salma::observations {
namespace {

double timeOf(const CObservationPanTilt& state) { return mrpt::Clock::toDouble(state.timestamp); }

}  // namespace

void CPanTiltHistory::add(const CObservationPanTilt::Ptr& state) {
    if (!state) throw std::invalid_argument("no pan/tilt state was given");
    const double time = timeOf(*state);
    if (!m_states.empty() && !(time >= timeOf(*m_states.back())))
        throw std::invalid_argument("pan/tilt state at " + std::to_string(time) +
                                    " s comes after " + std::to_string(timeOf(*m_states.back())) +
                                    " s");
    if (!m_states.empty() && time == timeOf(*m_states.back()))
        m_states.back() = state;
    else
        m_states.push_back(state);
}

std::optional<mrpt::poses::CPose3D> CPanTiltHistory::cameraPose(double time, double maxSkew) const {
    const auto place = bracket(
        m_states.size(), [this](std::size_t i) { return timeOf(*m_states[i]); }, time, maxSkew);
    if (!place) return std::nullopt;
    const CObservationPanTilt& a = *m_states[place->before];
    const CObservationPanTilt& b = *m_states[place->after];
    // Not the short way: a head cannot turn past its back, so its angles do not wrap.
    return a.cameraPose(a.pan + place->part * (b.pan - a.pan),
                        a.tilt + place->part * (b.tilt - a.tilt));
}

void CPanTiltHistory::forgetBefore(double time) {
    const auto later = std::find_if(m_states.begin(), m_states.end(),
                                    [time](const auto& state) { return timeOf(*state) > time; });
    if (later != m_states.begin()) m_states.erase(m_states.begin(), std::prev(later));
}

}  // namespace salma::observations
