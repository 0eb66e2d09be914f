// SPDX-License-Identifier: BSD-3-Clause
#include <salma/laser/CPlaceString.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "beams.h"

namespace salma::laser {

using mrpt::math::TPoint2D;
using observations::TPlaceLetter;
using observations::TPlaceString;

namespace {

constexpr double kSame = 0.3;  // ends of openings nearer to each other than this are one [m]

/// Whole millimetres: strings are read by people too.
double rounded(double metres) { return std::round(metres * 1000) / 1000; }

double cross(const TPoint2D& a, const TPoint2D& b) { return a.x * b.y - a.y * b.x; }
double dot(const TPoint2D& a, const TPoint2D& b) { return a.x * b.x + a.y * b.y; }

/// A wall in the scanner's place along the robot's axes, and the beams (counter-clockwise) on it.
struct TWall {
    TPoint2D from, to;
    std::size_t first, last;
    bool seenFrom{false}, seenTo{false};  //!< Its ends are its own.

    double length() const { return (to - from).norm(); }
    TPoint2D direction() const { return (to - from) * (1 / length()); }
    /// Distance behind the wall as seen by the scanner; negative before it.
    double behind(const TPoint2D& p) const { return -cross(direction(), p - from); }
};

TPoint2D nearestOn(const TWall& w, const TPoint2D& p) {
    const double t = std::clamp(dot(p - w.from, w.direction()), 0.0, w.length());
    return w.from + w.direction() * t;
}

/// What lies between two walls that follow each other.
struct TJoint {
    std::optional<char> letter;  //!< C, c, J or X.
    int sign{0};                 //!< Of a J: +1 if what follows is farther away.
};

/// A way between walls, from a jump edge to the nearest wall beyond.
struct TMouth {
    double width;
    TPoint2D edge, other;
};

class CReader {
 public:
    CReader(const TPlaceStringOptions& o,
            const mrpt::obs::CObservation2DRangeScan& scan,
            const TLineResult& lines)
        : m_options(o), m_step(lines.beamStep) {
        TLineResult counts;
        m_beams = readBeams(scan, kFarthest, counts);
        std::vector<std::size_t> place(scan.getScanSize());
        for (std::size_t i = 0; i < m_beams.size(); ++i) place[m_beams[i].index] = i;
        for (const TLine& line : lines.lines) {
            if (!(line.length() >= o.minWall) || line.lastPoint >= place.size()) continue;
            const auto [first, last] = std::minmax(place[line.firstPoint], place[line.lastPoint]);
            addWall({line.from - lines.sensor, line.to - lines.sensor, first, last});
        }
    }

    TPlaceString read() {
        std::vector<TJoint> joints;
        for (std::size_t i = 0; i + 1 < m_walls.size(); ++i) joints.push_back(joint(i));
        TPlaceString place;
        if (m_walls.empty()) return place;
        if (runWithoutEcho(0, m_walls.front().first)) place.push_back({'X', 0, 0});
        for (std::size_t i = 0; i < m_walls.size(); ++i) {
            place.push_back(wallLetter(m_walls[i]));
            if (i + 1 == m_walls.size() || !joints[i].letter) continue;
            const auto mouth = joints[i].letter == 'J' ? mouthAt(i, joints) : std::nullopt;
            if (mouth && joints[i].sign < 0) place.push_back(openingLetter(*mouth));
            place.push_back({*joints[i].letter, static_cast<double>(joints[i].sign), 0});
            if (mouth && joints[i].sign > 0) place.push_back(openingLetter(*mouth));
        }
        if (runWithoutEcho(m_walls.back().last + 1, m_beams.size())) place.push_back({'X', 0, 0});
        return place;
    }

 private:
    static constexpr double kFarthest = 1000;  // the lines have dropped what is too far

    /// Appends a wall, or lets the last one go on.
    void addWall(const TWall& wall) {
        if (!m_walls.empty() && continues(m_walls.back(), wall)) {
            m_walls.back().to = wall.to;
            m_walls.back().last = wall.last;
        } else {
            m_walls.push_back(wall);
        }
    }

    bool continues(const TWall& a, const TWall& b) const {
        constexpr double kTurn = 0.2, kOff = 0.15;  // sine; [m]
        const TWall joined{a.from, b.to, a.first, b.last};
        if (b.first <= a.last || !(std::abs(cross(a.direction(), b.direction())) < kTurn) ||
            dot(a.direction(), b.direction()) < 0)
            return false;
        for (const TPoint2D& p : {a.to, b.from})
            if (!(std::abs(joined.behind(p)) < kOff)) return false;
        if (!((b.from - a.to).norm() < m_options.maxGap)) return false;
        if (runWithoutEcho(a.last + 1, b.first)) return false;
        for (std::size_t i = a.last + 1; i < b.first; ++i)
            if (m_beams[i].valid() &&
                joined.behind({m_beams[i].x, m_beams[i].y}) > m_options.recess)
                return false;
        return true;
    }

    bool runWithoutEcho(std::size_t from, std::size_t to) const {
        int run = 0;
        for (std::size_t i = from; i < to; ++i) {
            run = m_beams[i].valid() ? 0 : run + 1;
            if (run >= m_options.noReturn) return true;
        }
        return false;
    }

    /// Tells how wall i and the next join, and which of their ends are their own.
    TJoint joint(std::size_t i) {
        TWall& a = m_walls[i];
        TWall& b = m_walls[i + 1];
        if (runWithoutEcho(a.last + 1, b.first)) return {'X', 0};
        const double turn = cross(a.direction(), b.direction());
        if (std::abs(turn) > std::sin(m_options.minAngle)) {
            const double along = cross(b.from - a.from, b.direction()) / turn;
            const TPoint2D corner = a.from + a.direction() * along;
            const auto reaches = [&](const TPoint2D& end) {
                return (end - corner).norm() <= m_options.cornerReach + spacing(end);
            };
            if (reaches(a.to) && reaches(b.from)) {
                a.to = b.from = corner;
                a.seenTo = b.seenFrom = true;
                return {turn > 0 ? 'c' : 'C', 0};
            }
        }
        const double jump = b.from.norm() - a.to.norm();
        if (!(std::abs(jump) > m_options.minJump)) return {};
        (jump > 0 ? a.seenTo : b.seenFrom) = true;
        return {'J', jump > 0 ? 1 : -1};
    }

    /// Way between neighbouring beams that far away, across them [m].
    double spacing(const TPoint2D& p) const { return m_step * p.norm(); }

    std::optional<TMouth> wayFrom(std::size_t i, int sign) const {
        std::optional<TMouth> mouth;
        const TPoint2D edge = sign > 0 ? m_walls[i].to : m_walls[i + 1].from;
        const std::size_t from = sign > 0 ? i + 1 : 0, to = sign > 0 ? m_walls.size() : i + 1;
        for (std::size_t k = from; k < to; ++k) {
            const TPoint2D other = nearestOn(m_walls[k], edge);
            const double width = (other - edge).norm();
            if (!mouth || width < mouth->width) mouth = TMouth{width, edge, other};
        }
        if (!mouth || !(mouth->width >= m_options.minOpening) ||
            !(mouth->width <= m_options.maxOpening))
            return std::nullopt;
        return mouth;
    }

    /// The opening at jump edge i; one between two jump edges is told at the first.
    std::optional<TMouth> mouthAt(std::size_t i, const std::vector<TJoint>& joints) const {
        const auto mouth = wayFrom(i, joints[i].sign);
        if (!mouth || joints[i].sign > 0) return mouth;
        for (std::size_t k = 0; k < i; ++k) {
            if (joints[k].letter != 'J' || joints[k].sign < 0) continue;
            const auto before = wayFrom(k, 1);
            if (before && (before->edge - mouth->other).norm() < kSame &&
                (before->other - mouth->edge).norm() < kSame)
                return std::nullopt;
        }
        return mouth;
    }

    TPlaceLetter wallLetter(const TWall& w) const {
        double variance = m_options.attributeSigma * m_options.attributeSigma;
        const auto add = [&](bool seen, const TPoint2D& end) {
            double sigma = std::max(m_options.hiddenSigma, m_options.hiddenShare * w.length());
            if (seen) {
                // along the wall neighbouring beams lie farther apart than across them
                const double facing = std::abs(cross(w.direction(), end)) / end.norm();
                sigma = std::min(sigma, 0.5 * spacing(end) / std::max(facing, 0.05));
            }
            variance += sigma * sigma;
        };
        add(w.seenFrom, w.from);
        add(w.seenTo, w.to);
        return {'W', rounded(w.length()), rounded(std::sqrt(variance))};
    }

    TPlaceLetter openingLetter(const TMouth& m) const {
        const double a = spacing(m.edge), b = spacing(m.other);
        const double least = m_options.attributeSigma;
        return {'O', rounded(m.width), rounded(std::sqrt(least * least + a * a + b * b))};
    }

    const TPlaceStringOptions& m_options;
    double m_step;
    std::vector<TBeam> m_beams;
    std::vector<TWall> m_walls;
};

}  // namespace

void TPlaceStringOptions::visit(config::COptionVisitor& v) {
    using namespace config;
    v.number("min_wall_m", minWall, moreThan(0), "shorter lines are no walls");
    v.number("recess_m", recess, moreThan(0), "a wall goes on past niches as deep as this");
    v.number("max_gap_m", maxGap, moreThan(0), "and past things in front as wide as this");
    v.number("corner_reach_m", cornerReach, moreThan(0), "both walls end this near to a corner");
    v.degrees("min_angle_deg", minAngle, between(5, 90), "between the walls of a corner");
    v.number("min_jump_m", minJump, moreThan(0), "of the range, at a jump edge");
    v.number("min_opening_m", minOpening, moreThan(0), "narrower ways between walls are none");
    v.number("max_opening_m", maxOpening, moreThan(0), "nor are wider ones");
    v.integer("no_return", noReturn, between(1, 1000), "beams in a row without echo make an X");
    v.number("attribute_sigma_m", attributeSigma, moreThan(0), "least sigma of a length or width");
    v.number("hidden_sigma_m", hiddenSigma, moreThan(0), "of a wall whose end is out of sight");
    v.number("hidden_share", hiddenShare, atLeast(0), "or this share of its length, if more");
}

CPlaceString::CPlaceString(const TPlaceStringOptions& options) : m_options(options) {
    m_options.validate();
}

TPlaceString CPlaceString::describe(const mrpt::obs::CObservation2DRangeScan& scan,
                                    const TLineResult& lines) const {
    return CReader(m_options, scan, lines).read();
}

}  // namespace salma::laser
