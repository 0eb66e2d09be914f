// SPDX-License-Identifier: BSD-3-Clause
#include "searchKernels.h"

#include <algorithm>
#include <cmath>

#include "simdTargets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "searchKernels.cpp"
#include <hwy/foreach_target.h>  // includes this file once for each instruction set
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace salma::saliency {
namespace HWY_NAMESPACE {
namespace {
namespace hn = hwy::HWY_NAMESPACE;

using D16 = hn::CappedTag<std::uint16_t, kPart>;
using D32 = hn::RepartitionToWide<D16>;
using DInt = hn::RebindToSigned<D32>;
using DFloat = hn::RebindToFloat<D32>;
using DDouble = hn::CappedTag<double, kPart>;
using VWords = hn::Vec<D32>;
using VInts = hn::Vec<DInt>;
using VFloats = hn::Vec<DFloat>;

constexpr int kShorts = static_cast<int>(hn::MaxLanes(D16()));
constexpr int kFloats = static_cast<int>(hn::MaxLanes(DFloat()));
constexpr int kDoubles = static_cast<int>(hn::MaxLanes(DDouble()));

/// Pixels of a ring, as words.
HWY_INLINE hn::Vec<D16> ringOf(const std::uint8_t* ring) {
    return hn::PromoteTo(D16(), hn::Load(hn::Rebind<std::uint8_t, D16>(), ring));
}

HWY_INLINE hn::Vec<D16> ringOf(const std::uint16_t* ring) { return hn::Load(D16(), ring); }

/// max(0, r N - n R) of pairs (r in the lower half, n in the upper half of a word).
template <class COUNT>
HWY_INLINE VInts growth(VWords pairs, VInts area, VInts ring, [[maybe_unused]] VInts both) {
    const DInt d;
    VInts difference;
#if HWY_TARGET <= HWY_AVX3
    if constexpr (sizeof(COUNT) == 1)  // counts below 2^15
        return hn::Max(VInts{_mm512_madd_epi16(pairs.raw, both.raw)}, hn::Zero(d));
#elif HWY_TARGET == HWY_AVX2
    if constexpr (sizeof(COUNT) == 1)
        return hn::Max(VInts{_mm256_madd_epi16(pairs.raw, both.raw)}, hn::Zero(d));
#elif HWY_TARGET == HWY_SSE4
    if constexpr (sizeof(COUNT) == 1)
        return hn::Max(VInts{_mm_madd_epi16(pairs.raw, both.raw)}, hn::Zero(d));
#endif
    const auto r = hn::BitCast(d, hn::And(pairs, hn::Set(D32(), 0xffff)));
    const auto n = hn::BitCast(d, hn::ShiftRight<16>(pairs));
    difference = hn::Sub(hn::Mul(r, area), hn::Mul(n, ring));
    return hn::Max(difference, hn::Zero(d));
}

/** n log2(n / N), to 3e-5 n. The exponent of n and its mantissa m less 1 are the bits of the float
 * n; a polynomial adds what log2(m) has beyond m - 1. */
class CLogs {
 public:
    explicit CLogs(float log2Area) : m_constant(hn::Set(d, kC[0] - 127 - log2Area)) {}

    HWY_INLINE VFloats addTo(VFloats sum, VInts n) const {
        const auto f = hn::ConvertTo(d, n);
        const auto bits = hn::BitCast(DInt(), f);
        const auto m = hn::BitCast(
            d, hn::OrAnd(hn::Set(DInt(), 0x3f800000), bits, hn::Set(DInt(), 0x007fffff)));
        auto p = hn::MulAdd(hn::Set(d, kC[5]), m, hn::Set(d, kC[4]));
        p = hn::MulAdd(p, m, hn::Set(d, kC[3]));
        p = hn::MulAdd(p, m, hn::Set(d, kC[2]));
        p = hn::MulAdd(p, m, hn::Set(d, kC[1]));
        p = hn::MulAdd(p, m, m_constant);
        const auto log = hn::MulAdd(hn::ConvertTo(d, bits), hn::Set(d, 1.0F / (1 << 23)), p);
        return hn::MulAdd(f, log, sum);
    }

 private:
    // Minimax polynomial of log2(m) - (m - 1) on [1, 2]: 1.3e-5.
    static constexpr float kC[6] = {-1.80036404F, 4.09171081F,   -3.55079293F,
                                    1.63114877F,  -0.416563687F, 0.0448736103F};
    static constexpr DFloat d{};
    VFloats m_constant;
};

/// Orders the bins by the first scale at which they occur about the centres of a part.
template <class COUNT>
void orderBins(const TScaleTables& tables, const COUNT* rings, TPart& part) {
    const hn::CappedTag<COUNT, kPart> d;
    constexpr int n = static_cast<int>(hn::MaxLanes(d));
    part.firstScale.clear();
    part.order.clear();
    for (int b = 0; b < part.present; ++b, rings += tables.scales() * kLanes) {
        int k = 0;
        const auto occurs = [&] {
            auto any = hn::Zero(d);
            for (int x = 0; x < kPart; x += n)
                any = hn::Or(any, hn::Load(d, rings + k * kLanes + x));
            return !hn::AllTrue(d, hn::Eq(any, hn::Zero(d)));
        };
        while (k < tables.scales() && !occurs()) ++k;
        const auto at = std::upper_bound(part.firstScale.begin(), part.firstScale.end(), k);
        part.order.insert(part.order.begin() + (at - part.firstScale.begin()), b);
        part.firstScale.insert(at, k);
    }
}

/// Counts, changes and entropies of all scales.
template <class COUNT>
HWY_NOINLINE void sumAll(const TScaleTables& tables, const COUNT* rings, TPart& part) {
    const D16 d16;
    const DInt di;
    const DFloat df;
    orderBins(tables, rings, part);
    std::fill_n(part.countsOf(-1), part.present * kPart, std::uint16_t{0});
    const int scales = tables.scales();
    const int ofScale = part.present * kPart;
    const COUNT* ringsOf[256];  // of the bins in order of their first scales
    std::uint16_t* countsOf[256];
    for (int i = 0; i < part.present; ++i) {
        const int b = part.order[static_cast<std::size_t>(i)];
        ringsOf[i] = rings + b * scales * kLanes;
        countsOf[i] = part.countsOf(0) + b * kPart;
    }
    int active = 0;
    for (int k = 0; k < scales; ++k) {
        while (active < part.present && part.firstScale[static_cast<std::size_t>(active)] <= k)
            ++active;
        const auto s = static_cast<std::size_t>(tables.sMin + k);
        const int area = tables.area[s];
        const int inRing = k > 0 ? tables.inRing(k) : 0;
        const auto areas = hn::Set(di, area);
        const auto inRings = hn::Set(di, inRing);
        const auto both = hn::Set(di, (area & 0xffff) | -inRing * 65536);
        const CLogs logs(tables.bound[static_cast<std::size_t>(k)].log2Area);
        for (int x = 0; x < kPart; x += kShorts) {
            const int ring = k * kLanes + x;
            const int count = k * ofScale + x;
            auto change0 = hn::Zero(di);
            auto change1 = hn::Zero(di);
            auto sum0 = hn::Zero(df);
            auto sum1 = hn::Zero(df);
            for (int i = 0; i < active; ++i) {
                const auto r = ringOf(ringsOf[i] + ring);
                const auto n = hn::Add(r, hn::Load(d16, countsOf[i] + count - ofScale));
                hn::Store(n, d16, countsOf[i] + count);
                const auto pairs0 = hn::ZipLower(r, n);
                const auto pairs1 = hn::ZipUpper(D32(), r, n);
                change0 = hn::Add(change0, growth<COUNT>(pairs0, areas, inRings, both));
                change1 = hn::Add(change1, growth<COUNT>(pairs1, areas, inRings, both));
                sum0 = logs.addTo(sum0, hn::BitCast(di, hn::ShiftRight<16>(pairs0)));
                sum1 = logs.addTo(sum1, hn::BitCast(di, hn::ShiftRight<16>(pairs1)));
            }
            for (int i = active; i < part.present; ++i)
                hn::Store(hn::Zero(d16), d16, countsOf[i] + count);
            const auto factor = hn::Set(df, -1.0F / static_cast<float>(area));
            std::int32_t* const change = part.change.get() + k * kPart + x;
            float* const entropy = part.entropy.get() + k * kPart + x;
            hn::Store(change0, di, change);
            hn::Store(change1, di, change + kFloats);
            hn::Store(hn::Mul(sum0, factor), df, entropy);
            hn::Store(hn::Mul(sum1, factor), df, entropy + kFloats);
        }
    }
}

/** W of `count` places from `first` on at scales 1..lastScale-1, from their changes up to
 * lastScale. The order of operations is part of the result. */
HWY_INLINE void computeW(
    const TScaleTables& tables, int first, int count, int lastScale, TPart& part) {
    const DDouble d;
    const hn::Rebind<std::int32_t, DDouble> di;
    constexpr int kChains = 4;  // each step waits for the one before
    const auto third = hn::Set(d, 1.0 / 3.0);
    for (int begin = first; begin < first + count; begin += kChains * kDoubles) {
        const int chains = std::min(kChains, (first + count - begin) / kDoubles);
        const auto dAt = [&](int k, int chain) {
            const std::int32_t* const change = part.change.get() + k * kPart + begin;
            return hn::Mul(hn::PromoteTo(d, hn::Load(di, change + chain * kDoubles)),
                           hn::Set(d, tables.dFactor[static_cast<std::size_t>(tables.sMin + k)]));
        };
        hn::Vec<DDouble> now[kChains];
        hn::Vec<DDouble> smoothed[kChains];
        for (int i = 0; i < chains; ++i) smoothed[i] = now[i] = dAt(1, i);  // D(sMin) is D(sMin+1)
        for (int k = 1; k < lastScale; ++k) {
            const auto factor =
                hn::Set(d, tables.wFactor[static_cast<std::size_t>(tables.sMin + k)]);
            double* const w = part.w.get() + k * kPart + begin;
            for (int i = 0; i < chains; ++i) {
                const auto next = dAt(k + 1, i);
                smoothed[i] = tables.smooth
                                  ? hn::Mul(hn::Add(smoothed[i], hn::Add(now[i], next)), third)
                                  : now[i];
                now[i] = next;
                hn::Store(hn::Mul(smoothed[i], factor), d, w + i * kDoubles);
            }
        }
    }
}

HWY_INLINE void clearMarks(const TScaleTables& tables, TPart& part) {
    const int n = (tables.scales() + kInWord - 1) / kInWord * kPart;
    std::fill_n(part.certain.get(), n, 0U);
    std::fill_n(part.possible.get(), n, 0U);
}

/// Entropies further apart than this are so in truth as well [bit].
HWY_INLINE float marginOf(const TPart& part) {
    return 8e-5F + 1e-6F * static_cast<float>(part.present);
}

/// Less than any entropy but 0, more than any estimate of 0 [bit].
constexpr float kNone = 1e-4F;

/** Collects the marks of the places from x on, in registers until a word is full or done. */
class CMarks {
 public:
    HWY_INLINE CMarks(int x, TPart& part)
        : m_x(x),
          m_margin(marginOf(part)),
          m_certain(hn::Zero(d)),
          m_possible(hn::Zero(d)),
          m_part(part) {}
    HWY_INLINE ~CMarks() { store(); }
    CMarks(const CMarks&) = delete;
    CMarks& operator=(const CMarks&) = delete;

    /// Scale k, which `allowed` may forbid, by the entropies at k - 1, k and k + 1.
    HWY_INLINE void add(
        int k, VFloats before, VFloats at, VFloats after, hn::Mask<DFloat> allowed) {
        const DFloat df;
        if (k / kInWord != m_word) {
            store();
            m_certain = m_possible = hn::Zero(d);
            m_word = k / kInWord;
        }
        const auto least = hn::Min(hn::Sub(at, before), hn::Sub(at, after));
        const auto bit = hn::Set(d, 1U << (k % kInWord));
        const auto some = hn::And(allowed, hn::Gt(at, hn::Set(df, kNone)));
        const auto marked = [&](float above) {
            const auto mask = hn::And(some, hn::Gt(least, hn::Set(df, above)));
            return hn::IfThenElseZero(hn::RebindMask(d, mask), bit);
        };
        m_certain = hn::Or(m_certain, marked(m_margin));
        m_possible = hn::Or(m_possible, marked(-m_margin));
    }

 private:
    HWY_INLINE void store() {
        hn::Store(m_certain, d, m_part.certain.get() + m_word * kPart + m_x);
        hn::Store(m_possible, d, m_part.possible.get() + m_word * kPart + m_x);
    }

    static constexpr D32 d{};
    int m_x;
    int m_word{0};
    float m_margin;
    VWords m_certain;
    VWords m_possible;
    TPart& m_part;
};

template <class COUNT>
void search(const TScaleTables& tables, const COUNT* rings, TPart& part) {
    const DFloat d;
    sumAll(tables, rings, part);
    const int scales = tables.scales();
    computeW(tables, 0, kPart, scales - 1, part);
    clearMarks(tables, part);
    const auto all = hn::FirstN(d, kFloats);
    for (int x = 0; x < kPart; x += kFloats) {
        CMarks marks(x, part);
        const float* const entropy = part.entropy.get() + x;
        auto before = hn::Load(d, entropy);
        auto at = hn::Load(d, entropy + kPart);
        for (int k = 1; k + 1 < scales; ++k) {
            const auto after = hn::Load(d, entropy + (k + 1) * kPart);
            marks.add(k, before, at, after, all);
            before = at;
            at = after;
        }
    }
    // What ZipLower and ZipUpper do to the order of centres.
    HWY_ALIGN std::uint16_t centres[kPart];
    HWY_ALIGN std::uint32_t zipped[kPart];
    for (int x = 0; x < kPart; ++x) centres[x] = static_cast<std::uint16_t>(x);
    const D16 d16;
    for (int x = 0; x < kPart; x += kShorts) {
        const auto c = hn::Load(d16, centres + x);
        hn::Store(hn::ZipLower(c, hn::Zero(d16)), D32(), zipped + x);
        hn::Store(hn::ZipUpper(D32(), c, hn::Zero(d16)), D32(), zipped + x + kFloats);
    }
    for (int i = 0; i < kPart; ++i) part.place[zipped[i]] = static_cast<std::uint8_t>(i);
}

// ---------------------------------------------------------------- searching above a threshold

constexpr double kRoundedUp = 1 + 1e-5;  // more than what floats lose

template <class COUNT>
void addOverlap(const TScaleTables& tables,
                const COUNT* rings,
                int scales,
                std::size_t stride,
                std::uint16_t* overlap) {
    const D16 d;
    for (int row = 0; row < kBandRows; ++row, rings += stride, overlap += tables.scales() * kLanes)
        for (int x = 0; x < kLanes; x += kShorts) {
            auto n = ringOf(rings + x);
            for (int k = 1; k < scales; ++k) {
                const auto& bound = tables.bound[static_cast<std::size_t>(k)];
                const auto r = ringOf(rings + k * kLanes + x);
                const auto inRing = hn::Mul(r, hn::Set(d, bound.perPixel));
                const auto inDisc =
                    hn::MulHigh(hn::Mul(n, hn::Set(d, bound.toTop)), hn::Set(d, bound.perTop));
                std::uint16_t* const sum = overlap + k * kLanes + x;
                hn::Store(hn::Add(hn::Load(d, sum), hn::Min(inRing, inDisc)), d, sum);
                n = hn::Add(n, r);
            }
        }
}

int lastScale(const TScaleTables& tables,
              const std::uint16_t* overlap,
              int scales,
              int count,
              const std::uint16_t* atLeast) {
    const D16 d;
    const auto third = hn::Set(d, 65536 / 3);
    auto last = hn::Zero(d);
    for (int x = 0; x < count; x += kShorts) {
        const auto dAt = [&](int k) {
            const auto& bound = tables.bound[static_cast<std::size_t>(k)];
            const auto rest =
                hn::Sub(hn::Set(d, bound.whole), hn::Load(d, overlap + k * kLanes + x));
            return hn::MulHigh(rest, hn::Set(d, bound.toD));
        };
        auto now = dAt(1);
        auto smoothed = now;
        auto found = hn::Zero(d);
        for (int k = 1; k + 1 < scales; ++k) {
            const auto next = dAt(k + 1);
            smoothed =
                tables.smooth ? hn::MulHigh(hn::Add(hn::Add(smoothed, now), next), third) : now;
            now = next;
            const auto high = hn::Eq(hn::Max(smoothed, hn::Set(d, atLeast[k])), smoothed);
            found = hn::IfThenElse(high, hn::Set(d, static_cast<std::uint16_t>(k)), found);
        }
        const auto exist = hn::FirstN(d, static_cast<std::size_t>(std::min(kShorts, count - x)));
        last = hn::Max(last, hn::IfThenElseZero(exist, found));
    }
    HWY_ALIGN std::uint16_t lanes[kShorts];
    hn::Store(last, d, lanes);
    return *std::max_element(lanes, lanes + kShorts);
}

/// Counts of scales 0..lastScale.
template <class COUNT>
void sumCounts(const TScaleTables& tables, const COUNT* rings, int lastScale, TPart& part) {
    const D16 d;
    for (int b = 0; b < part.present; ++b, rings += tables.scales() * kLanes)
        for (int x = 0; x < kPart; x += kShorts) {
            auto n = hn::Zero(d);
            for (int k = 0; k <= lastScale; ++k) {
                n = hn::Add(n, ringOf(rings + k * kLanes + x));
                hn::Store(n, d, part.countsOf(k) + b * kPart + x);
            }
        }
}

/// Bounds of W up to lastScale, in the order of centres.
HWY_INLINE void boundW(const TScaleTables& tables,
                       const std::uint16_t* overlap,
                       int lastScale,
                       TPart& part) {
    const DFloat d;
    const DInt di;
    const hn::Rebind<std::uint16_t, DFloat> d16;
    for (int x = 0; x < kPart; x += kFloats) {
        const auto dAt = [&](int k) {
            const auto s = static_cast<std::size_t>(tables.sMin + k);
            const int whole = tables.bound[static_cast<std::size_t>(k)].whole;
            const double factor = 2.0 * tables.inRing(k) / tables.area[s] / whole;
            const auto same = hn::PromoteTo(di, hn::Load(d16, overlap + k * kLanes + x));
            return hn::Mul(hn::ConvertTo(d, hn::Sub(hn::Set(di, whole), same)),
                           hn::Set(d, static_cast<float>(factor)));
        };
        auto now = dAt(1);
        auto smoothed = now;
        for (int k = 1; k <= lastScale; ++k) {
            const auto next = dAt(k + 1);
            const auto sum = hn::Add(hn::Add(smoothed, now), next);
            smoothed = tables.smooth ? hn::Mul(sum, hn::Set(d, 1.0F / 3.0F)) : now;
            now = next;
            const double factor = tables.wFactor[static_cast<std::size_t>(tables.sMin + k)];
            hn::Store(hn::Mul(smoothed, hn::Set(d, static_cast<float>(factor * kRoundedUp))), d,
                      part.wBound.get() + k * kPart + x);
        }
    }
}

HWY_INLINE VFloats entropyOf(const TScaleTables& tables, const TPart& part, int k, int x) {
    const DFloat d;
    const DInt di;
    const hn::Rebind<std::uint16_t, DFloat> d16;
    const int area = tables.area[static_cast<std::size_t>(tables.sMin + k)];
    const CLogs logs(tables.bound[static_cast<std::size_t>(k)].log2Area);
    auto sum = hn::Zero(d);
    const std::uint16_t* count = part.countsOf(k) + x;
    for (int b = 0; b < part.present; ++b, count += kPart)
        sum = logs.addTo(sum, hn::PromoteTo(di, hn::Load(d16, count)));
    return hn::Mul(sum, hn::Set(d, -1.0F / static_cast<float>(area)));
}

/// Changes of the places from x on at scales 1..lastScale.
HWY_INLINE void computeChanges(const TScaleTables& tables, int x, int lastScale, TPart& part) {
    const DInt di;
    const hn::Rebind<std::uint16_t, DFloat> d16;
    for (int k = 1; k <= lastScale; ++k) {
        const auto s = static_cast<std::size_t>(tables.sMin + k);
        const auto area = hn::Set(di, tables.area[s]);
        const auto before = hn::Set(di, tables.area[s - 1]);
        auto change = hn::Zero(di);
        const std::uint16_t* count = part.countsOf(k) + x;
        for (int b = 0; b < part.present; ++b, count += kPart) {
            const auto n = hn::PromoteTo(di, hn::Load(d16, count));
            const auto old = hn::PromoteTo(di, hn::Load(d16, count - part.present * kPart));
            // r N' - n' R, with r = n - n' and R = N - N'
            change = hn::Add(
                change, hn::Max(hn::Sub(hn::Mul(n, before), hn::Mul(old, area)), hn::Zero(di)));
        }
        hn::Store(change, di, part.change.get() + k * kPart + x);
    }
}

template <class COUNT>
void searchAbove(const TScaleTables& tables,
                 const COUNT* rings,
                 const std::uint16_t* overlap,
                 int lastScale,
                 double yMin,
                 TPart& part) {
    const DFloat d;
    sumCounts(tables, rings, lastScale + 1, part);
    boundW(tables, overlap, lastScale, part);
    clearMarks(tables, part);
    for (int i = 0; i < kPart; ++i) part.place[i] = static_cast<std::uint8_t>(i);
    const auto least = hn::Set(d, static_cast<float>(yMin / tables.logTwo / kRoundedUp));
    const auto highest = hn::Set(d, static_cast<float>(std::log2(part.present)) + 1e-4F);
    for (int x = 0; x < kPart; x += kFloats) {
        const float* const w = part.wBound.get() + x;
        CMarks marks(x, part);
        int lastCandidate = 0;
        int entropiesTo = -1;  // scales whose entropies are known, of those last asked for
        for (int k = 1; k <= lastScale; ++k) {
            const auto wHere = hn::Load(d, w + k * kPart);
            if (hn::AllFalse(d, hn::Ge(hn::Mul(wHere, highest), least))) continue;
            float* const entropy = part.entropy.get() + k * kPart + x;
            for (int i = std::max(k - 1, entropiesTo + 1); i <= k + 1; ++i)
                hn::Store(entropyOf(tables, part, i, x), d, part.entropy.get() + i * kPart + x);
            entropiesTo = k + 1;
            const auto at = hn::Load(d, entropy);
            const auto salient = hn::Ge(hn::Mul(wHere, hn::Add(at, hn::Set(d, 1e-4F))), least);
            if (hn::AllFalse(d, salient)) continue;
            lastCandidate = k;
            marks.add(k, hn::Load(d, entropy - kPart), at, hn::Load(d, entropy + kPart), salient);
        }
        if (lastCandidate == 0) continue;
        computeChanges(tables, x, lastCandidate + 1, part);
        computeW(tables, x, kFloats, lastCandidate + 1, part);
    }
}

TSearchKernels<std::uint8_t> byteKernels() {
    return {addOverlap<std::uint8_t>, lastScale, search<std::uint8_t>, searchAbove<std::uint8_t>};
}

TSearchKernels<std::uint16_t> wordKernels() {
    return {addOverlap<std::uint16_t>, lastScale, search<std::uint16_t>,
            searchAbove<std::uint16_t>};
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace salma::saliency
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace salma::saliency {

TPart::TPart(const TScaleTables& tables) {
    const auto n = static_cast<std::size_t>(tables.scales() * kPart);
    const auto words = static_cast<std::size_t>((tables.scales() + kInWord - 1) / kInWord * kPart);
    counts =
        hwy::AllocateAligned<std::uint16_t>((n + kPart) * static_cast<std::size_t>(tables.bins));
    change = hwy::AllocateAligned<std::int32_t>(n);
    entropy = hwy::AllocateAligned<float>(n);
    wBound = hwy::AllocateAligned<float>(n);
    w = hwy::AllocateAligned<double>(n);
    certain = hwy::AllocateAligned<std::uint32_t>(words);
    possible = hwy::AllocateAligned<std::uint32_t>(words);
}

template <>
TSearchKernels<std::uint8_t> searchKernels(ESimd simd) {
    return SALMA_MADE_FOR(simd, TSearchKernels<std::uint8_t>(*)(), byteKernels)();
}

template <>
TSearchKernels<std::uint16_t> searchKernels(ESimd simd) {
    return SALMA_MADE_FOR(simd, TSearchKernels<std::uint16_t>(*)(), wordKernels)();
}

}  // namespace salma::saliency
#endif
