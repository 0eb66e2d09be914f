// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/core/bits_math.h>
#include <salma/appearance/CPatchMatcher.h>
#include <salma/association/CDataAssociator.h>
#include <salma/slam/CLandmarkTable.h>
#include <salma/slam/rangeBearing.h>

#include <memory>
#include <string>

namespace salma::slam {

/// `..._insertOpts` in the ini files of MRPT's programs; salma-slam fills it from [ekf] and [rbpf].
struct TLandmarkMapOptions : public config::TStrictOptions<TLandmarkMapOptions> {
    bool ignoreIdentities{false};  //!< Identities in the log are not read.
    int minSightingsCorner{3};     //!< Sightings before a corner counts as a landmark.
    int provisionalSteps{20};      //!< Insertions until a corner with fewer is forgotten.
    int maxPatches{4};             //!< Views of a salient landmark that are kept.
    double patchSpread{mrpt::DEG2RAD(15.0)};  //!< Least difference of two kept views [rad].

    /// A particle's heading is a sample: walls are compared with this uncertainty of it [rad].
    double headingSigma{mrpt::DEG2RAD(1.0)};
    /// In one track appearance counts again after this change of the viewing angle [rad].
    double decorrelation{mrpt::DEG2RAD(35.0)};
    double trackGap{10};  //!< A landmark that was not paired for longer begins another track [s].

    void visit(config::COptionVisitor& v);
};

/// All options of a landmark map.
struct TLandmarkMapSetup {
    TLandmarkMapOptions map;
    association::TAssociationOptions association;
    appearance::TMatcherOptions matcher;
    appearance::TRegionMatchOptions regionMatcher;
    TRangeBearingOptions rangeBearing;

    /** Reads `PREFIX_insertOpts`, `PREFIX_associationOpts`, `PREFIX_matcherOpts`,
     * `PREFIX_regionMatcherOpts` and `PREFIX_rangeBearingOpts`; each may be missing.
     * \throw std::invalid_argument naming file, section, key and value. */
    void load(const mrpt::config::CConfigFileBase& file, const std::string& prefix);

    /// Those sections with every key.
    std::string asIni(const std::string& prefix) const;
};

/** Options of landmark maps with what works by them; the particles of a filter share one.
 *
 * It remembers the likelihood ratios of the patches that it was asked for last, since every
 * particle asks for the same. Safe to use from several threads. */
class CLandmarkMapSetup {
 public:
    /// \throw std::invalid_argument if the options contradict each other.
    explicit CLandmarkMapSetup(const TLandmarkMapSetup& options = {});
    ~CLandmarkMapSetup();

    const TLandmarkMapSetup& options() const { return m_options; }
    const association::CDataAssociator& associator() const { return *m_associator; }

    /// Log likelihood ratio of a seen patch and a stored one.
    double logRatio(const observations::TPatch& seen, const observations::TPatch& stored) const;
    /// The same as a function, which must not outlive this object.
    PatchRatio patchRatio() const {
        return [this](const auto& seen, const auto& stored) { return logRatio(seen, stored); };
    }

 private:
    struct TMemory;

    TLandmarkMapSetup m_options;
    std::unique_ptr<association::CDataAssociator> m_associator;
    appearance::CPatchMatcher m_matcher;
    std::unique_ptr<TMemory> m_memory;
};

}  // namespace salma::slam
