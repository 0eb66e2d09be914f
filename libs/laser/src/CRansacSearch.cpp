// SPDX-License-Identifier: BSD-3-Clause
#include "CRansacSearch.h"

namespace salma::laser {
namespace {

constexpr std::uint32_t kNear = 4;   // choices for the second point of every other hypothesis
constexpr std::uint8_t kEnough = 3;  // hypotheses whose runs pass over a point: ask elsewhere

}  // namespace

CRansacSearch::CRansacSearch(const TLineOptions& options, const CFreePoints& points)
    : m_options(options), m_points(points), m_random(static_cast<std::uint64_t>(options.seed)) {
    m_hypotheses.reserve(static_cast<std::size_t>(options.hypotheses));
}

TCandidate CRansacSearch::next() {
    const auto weaker = [](const THypothesis& a, const THypothesis& b) {
        return a.run.support < b.run.support;
    };
    for (;;) {
        if (m_hypotheses.empty() && !(m_fruitful && draw())) return {};
        const auto best = std::max_element(m_hypotheses.begin(), m_hypotheses.end(), weaker);
        const TRun now =
            m_points.isFree(best->seed) ? m_points.measure(best->fit, best->seed) : TRun();
        const bool whole = now.points == best->run.points;
        const THypothesis hypothesis = *best;
        best->run = now;
        if (whole || now.points < static_cast<std::uint32_t>(m_options.minPoints)) {
            *best = m_hypotheses.back();
            m_hypotheses.pop_back();
        }
        if (!whole) continue;
        m_fruitful = true;
        TCandidate candidate{hypothesis.fit, {}};
        m_points.collect(hypothesis.fit, hypothesis.seed, candidate.members);
        settle(m_points, candidate);
        return candidate;
    }
}

/// Splitmix64: good enough, and needs no seeding that would cost as much as a scan.
std::uint32_t CRansacSearch::random() {
    std::uint64_t x = m_random += 0x9E3779B97F4A7C15ULL;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
    return static_cast<std::uint32_t>(x >> 32);
}

bool CRansacSearch::draw() {
    m_fruitful = false;
    m_covered.assign(m_points.size(), 0);
    std::vector<std::uint32_t> candidates;
    candidates.reserve(m_points.size());
    for (std::uint32_t i = 0; i < m_points.size(); ++i)
        if (m_points.isFree(i)) candidates.push_back(i);
    if (candidates.size() < static_cast<std::size_t>(m_options.minPoints)) return false;
    const auto far = static_cast<std::uint32_t>(m_options.window - 1);
    const auto samples =
        std::min(static_cast<std::size_t>(m_options.hypotheses), 2 * candidates.size());
    for (std::size_t h = 0; h < samples; ++h)  // strata: every part of the scan is asked
        drawFrom(candidates[h * candidates.size() / samples],
                 h % 2 == 0 ? std::min(kNear, far) : far);
    return !m_hypotheses.empty();
}

void CRansacSearch::drawFrom(std::uint32_t i, std::uint32_t span) {
    if (m_covered[i] >= kEnough) return;
    const std::uint32_t j = i + 2 + random() % span;
    if (j >= m_points.size() || !m_points.isFree(j)) return;
    const auto line = lineThrough(m_points[i], m_points[j]);
    if (!line) return;
    if (!m_points.fits(*line, (i + j) / 2)) return;
    const TRun run = m_points.measure(*line, i);
    if (run.points < static_cast<std::uint32_t>(m_options.minPoints)) return;
    m_hypotheses.push_back({*line, i, run});
    for (std::uint32_t k = run.first; k <= run.last; ++k)
        if (m_covered[k] < kEnough) ++m_covered[k];
}

}  // namespace salma::laser
