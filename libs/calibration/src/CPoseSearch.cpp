// SPDX-License-Identifier: BSD-3-Clause
#include "CPoseSearch.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <salma/laser/CLineExtractor.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace salma::calibration {
namespace {

/// Linear equations for nine numbers need five boards of two equations each.
constexpr std::size_t kSample = 5;

/// A piece that is taken to lie on a plane.
using TMatch = std::pair<const TPlane*, const TScanPiece*>;

/** H = [r1 r2 t] from n . (H (x, y, 1)) = d at both ends of each piece, then the nearest rotation.
 * Nothing if the pieces do not determine it or the columns are far from those of a rotation. */
std::optional<TLaserPose> linearPose(const std::vector<TMatch>& matches) {
    Eigen::MatrixXd A(2 * static_cast<Eigen::Index>(matches.size()), 9);
    Eigen::VectorXd b(A.rows());
    Eigen::Index row = 0;
    for (const auto& [plane, piece] : matches)
        for (const auto& p : {piece->from, piece->to}) {
            const Eigen::RowVector3d n = plane->normal.transpose();
            A.row(row) << n * p.x, n * p.y, n;
            b[row++] = plane->distance;
        }
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(A);
    if (std::abs(qr.matrixR()(8, 8)) < 1e-4 * std::abs(qr.matrixR()(0, 0))) return std::nullopt;
    const Eigen::VectorXd h = qr.solve(b);
    const Eigen::Vector3d r1 = h.segment<3>(0), r2 = h.segment<3>(3);
    for (const double length : {r1.norm(), r2.norm()})
        if (!(length > 0.5 && length < 2)) return std::nullopt;
    Eigen::Matrix3d M;
    M << r1.normalized(), r2.normalized(), r1.cross(r2).normalized();
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(M, Eigen::ComputeFullU | Eigen::ComputeFullV);
    TLaserPose pose;
    pose.R = svd.matrixU() * svd.matrixV().transpose();
    if (pose.R.determinant() < 0) return std::nullopt;
    pose.t = h.segment<3>(6);
    return pose;
}

/// Gauss-Newton on the distances of both ends and the middle of each piece from its plane.
void refine(const std::vector<TMatch>& matches, int rounds, TLaserPose& pose) {
    using TVector6 = Eigen::Matrix<double, 6, 1>;
    for (int round = 0; round < rounds; ++round) {
        Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Identity() * 1e-9;
        TVector6 gradient = TVector6::Zero();
        for (const auto& [plane, piece] : matches)
            for (const double part : {0.0, 0.5, 1.0}) {
                const auto p = piece->from * (1 - part) + piece->to * part;
                const Eigen::Vector3d turned = pose.map(p.x, p.y) - pose.t;
                TVector6 J;
                J << turned.cross(plane->normal), plane->normal;
                normal += J * J.transpose();
                gradient += J * plane->offset(turned + pose.t);
            }
        const TVector6 step = -normal.ldlt().solve(gradient);
        if (!step.allFinite()) return;
        const Eigen::Vector3d turn = step.head<3>();
        if (turn.norm() > 0)
            pose.R = Eigen::AngleAxisd(turn.norm(), turn.normalized()).toRotationMatrix() * pose.R;
        pose.t += step.tail<3>();
    }
}

/// Of a piece: the farther end.
double misfitOf(const TLaserPose& pose, const TPlane& plane, const TScanPiece& piece) {
    return std::max(std::abs(plane.offset(pose.map(piece.from.x, piece.from.y))),
                    std::abs(plane.offset(pose.map(piece.to.x, piece.to.y))));
}

}  // namespace

std::vector<TScanPiece> piecesOf(const TRangeScan& scan,
                                 const TBoardInScan& board,
                                 const TLaserCameraOptions& options) {
    mrpt::obs::CObservation2DRangeScan record;
    const std::size_t n = scan.ranges.size();
    record.aperture = static_cast<float>(std::abs(scan.step) * static_cast<double>(n - 1));
    record.rightToLeft = scan.step > 0;
    record.maxRange = 1000;
    record.resizeScan(n);
    for (std::size_t i = 0; i < n; ++i) {
        const bool valid = std::isfinite(scan.ranges[i]);
        record.setScanRange(i, valid ? static_cast<float>(scan.ranges[i]) : 0.0F);
        record.setScanRangeValidity(i, valid);
    }
    record.sensorPose.setYawPitchRoll((scan.start + scan.direction(n - 1)) / 2, 0, 0);
    laser::TLineOptions lines;
    lines.inlier = 0.03;
    lines.gap = 0.15;
    lines.minPoints = options.minPoints;
    const double distance = board.centre.norm();
    std::vector<TScanPiece> pieces;
    for (const auto& line : laser::CLineExtractor(lines).extract(record).lines) {
        const double away = ((line.from + line.to) * 0.5).norm();
        if (line.length() > 2.5 * board.radius || line.length() < 0.3 * board.radius ||
            std::abs(away - distance) > options.maxBaseline + board.radius)
            continue;
        pieces.push_back({line.from, line.to});
    }
    return pieces;
}

std::optional<TLaserPose> CPoseSearch::find() const {
    std::vector<std::size_t> usable;
    for (std::size_t i = 0; i < m_boards.size(); ++i)
        if (!m_boards[i].pieces.empty()) usable.push_back(i);
    if (usable.size() < std::max(kSample, static_cast<std::size_t>(m_options.minPairs)))
        return std::nullopt;
    std::mt19937 random(static_cast<unsigned>(m_options.seed));
    TLaserPose best;
    TAgreement most;
    for (int i = 0; i < m_options.samples; ++i) {
        std::vector<TMatch> matches;
        for (std::size_t k = 0; k < kSample; ++k) {  // the first of a shuffle
            std::swap(usable[k], usable[k + random() % (usable.size() - k)]);
            const auto& board = m_boards[usable[k]];
            matches.emplace_back(&board.plane, &board.pieces[random() % board.pieces.size()]);
        }
        auto pose = linearPose(matches);
        if (!pose) continue;
        refine(matches, 4, *pose);
        if (!(pose->t.norm() <= m_options.maxBaseline)) continue;
        TAgreement found = agreement(*pose);
        if (!found.isBetterThan(most)) continue;
        polish(*pose, found);
        best = *pose;
        most = std::move(found);
    }
    if (most.count < static_cast<std::size_t>(m_options.minPairs)) return std::nullopt;
    return best;
}

CPoseSearch::TAgreement CPoseSearch::agreement(const TLaserPose& pose) const {
    TAgreement found;
    found.piece.resize(m_boards.size());
    for (std::size_t i = 0; i < m_boards.size(); ++i) {
        const auto& board = m_boards[i];
        double least = m_options.tolerance;
        for (std::size_t k = 0; k < board.pieces.size(); ++k) {
            const auto& piece = board.pieces[k];
            const auto middle = (piece.from + piece.to) * 0.5;
            const double misfit = misfitOf(pose, board.plane, piece);
            if (!(misfit < least) ||
                (pose.map(middle.x, middle.y) - board.centre).norm() > board.radius)
                continue;
            least = misfit;
            found.piece[i] = k;
        }
        if (!found.piece[i]) continue;
        ++found.count;
        found.misfit += least;
    }
    return found;
}

void CPoseSearch::polish(TLaserPose& pose, TAgreement& with) const {
    for (int round = 0; round < 3; ++round) {
        std::vector<TMatch> matches;
        for (std::size_t i = 0; i < m_boards.size(); ++i)
            if (with.piece[i])
                matches.emplace_back(&m_boards[i].plane, &m_boards[i].pieces[*with.piece[i]]);
        if (matches.size() < 3) return;
        TLaserPose better = pose;
        refine(matches, 3, better);
        const TAgreement now = agreement(better);
        if (!now.isBetterThan(with)) return;
        pose = better;
        with = now;
    }
}

}  // namespace salma::calibration
