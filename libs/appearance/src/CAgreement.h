// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/appearance/CPatchMatcher.h>

#include <vector>

#include "fitSimilarity.h"
#include "matchKeypoints.h"

namespace salma::appearance {

/// Finds the keypoint pairs that agree on one similarity near to the identity.
class CAgreement {
 public:
    /// All must outlive this object.
    CAgreement(const TMatcherOptions& options,
               const std::vector<observations::TKeypoint>& a,
               const std::vector<observations::TKeypoint>& b)
        : m_options(options), m_a(a), m_b(b) {}

    /// The largest set found among `putative`; perhaps empty.
    KeypointPairs agreeing(const KeypointPairs& putative) const;

    /// Where the keypoints of the pairs are.
    std::vector<TPointPair> points(const KeypointPairs& pairs) const;

 private:
    KeypointPairs upright(const KeypointPairs& pairs) const;
    KeypointPairs following(const TSimilarity& s, const KeypointPairs& pairs) const;
    TSimilarity commonShift(const KeypointPairs& pairs) const;
    bool nearIdentity(const TSimilarity& s) const;

    const TMatcherOptions& m_options;
    const std::vector<observations::TKeypoint>& m_a;
    const std::vector<observations::TKeypoint>& m_b;
};

}  // namespace salma::appearance
