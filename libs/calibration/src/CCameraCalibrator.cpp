// SPDX-License-Identifier: BSD-3-Clause
#include <salma/calibration/CCameraCalibrator.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <opencv2/calib3d.hpp>
#include <stdexcept>

#include "opencvTypes.h"

namespace salma::calibration {
namespace {

using mrpt::math::TPoint2D;

constexpr int kIntrinsics = 9;  ///< fx, fy, cx, cy, k1, k2, p1, p2, k3
constexpr std::size_t kLeastViews = 3;
/// Of the focal length: with more, the views do not determine the camera.
constexpr double kWorstFocalSigma = 0.05;

void checkViews(const std::vector<TPoint2D>& board, const std::vector<TBoardView>& views) {
    if (views.size() < kLeastViews)
        throw std::invalid_argument("a camera needs " + std::to_string(kLeastViews) +
                                    " pictures of a board, seen from different directions, not " +
                                    std::to_string(views.size()));
    for (const auto& view : views) {
        if (view.pixels.size() != board.size())
            throw std::invalid_argument(view.name + ": " + std::to_string(view.pixels.size()) +
                                        " points for a board of " + std::to_string(board.size()));
        for (const auto& p : view.pixels)
            if (!std::isfinite(p.x) || !std::isfinite(p.y))
                throw std::invalid_argument(view.name + ": a point that is not finite");
    }
}

int flagsOf(const TCameraCalibrationOptions& options) {
    int flags = 0;
    if (options.radialTerms < 3) flags |= cv::CALIB_FIX_K3;
    if (options.radialTerms < 2) flags |= cv::CALIB_FIX_K2;
    if (options.radialTerms < 1) flags |= cv::CALIB_FIX_K1;
    if (!options.tangential) flags |= cv::CALIB_ZERO_TANGENT_DIST;
    return flags;
}

/// Which of the nine intrinsics are estimated.
std::vector<Eigen::Index> freeOnes(const TCameraCalibrationOptions& options) {
    std::vector<Eigen::Index> free{0, 1, 2, 3};
    for (int k = 0; k < std::min(2, options.radialTerms); ++k) free.push_back(4 + k);
    if (options.tangential) free.insert(free.end(), {6, 7});
    if (options.radialTerms == 3) free.push_back(8);
    return free;
}

struct TSolution {
    mrpt::img::TCamera camera;
    std::vector<cv::Mat> rotations, translations;
};

TSolution solve(const std::vector<TPoint2D>& board,
                const std::vector<TBoardView>& views,
                const cv::Size& size,
                const TCameraCalibrationOptions& options) {
    const std::vector<std::vector<cv::Point3f>> objects(views.size(), onPlane(board));
    std::vector<std::vector<cv::Point2f>> pictures;
    for (const auto& view : views) pictures.push_back(asPixels(view.pixels));
    cv::Mat K, distortion;
    TSolution found;
    const cv::TermCriteria criteria(cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 200, 1e-12);
    try {
        cv::calibrateCamera(objects, pictures, size, K, distortion, found.rotations,
                            found.translations, flagsOf(options), criteria);
    } catch (const cv::Exception&) {
        throw std::runtime_error("the pictures of the board do not determine a camera");
    }
    found.camera.ncols = static_cast<std::uint32_t>(size.width);
    found.camera.nrows = static_cast<std::uint32_t>(size.height);
    found.camera.setIntrinsicParamsFromValues(K.at<double>(0, 0), K.at<double>(1, 1),
                                              K.at<double>(0, 2), K.at<double>(1, 2));
    const auto* d = distortion.ptr<double>();
    found.camera.setDistortionPlumbBob(d[0], d[1], d[2], d[3], d[4]);
    return found;
}

TViewResiduals residualsOf(const std::vector<TPoint2D>& seen,
                           const std::vector<cv::Point2f>& expected) {
    TViewResiduals result;
    double squares = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        result.errors.push_back(seen[i] - TPoint2D(expected[i].x, expected[i].y));
        squares += std::pow(result.errors.back().x, 2) + std::pow(result.errors.back().y, 2);
    }
    result.rms = std::sqrt(squares / static_cast<double>(seen.size()));
    return result;
}

/** Normal equations of the intrinsics, each board's pose eliminated by its Schur complement.
 * With J = [A B], A of the intrinsics, B of one pose: sum of A'A - A'B (B'B)^-1 B'A. */
class CInformation {
 public:
    explicit CInformation(std::vector<Eigen::Index> free)
        : m_free(std::move(free)),
          m_sum(Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(m_free.size()),
                                      static_cast<Eigen::Index>(m_free.size()))) {}

    /// \param jacobian As cv::projectPoints gives it: rotation, translation, f, c, distortion.
    void add(const cv::Mat& jacobian) {
        Eigen::MatrixXd A(jacobian.rows, static_cast<Eigen::Index>(m_free.size()));
        Eigen::MatrixXd B(jacobian.rows, 6);
        for (int r = 0; r < jacobian.rows; ++r) {
            const auto* row = jacobian.ptr<double>(r);
            for (int c = 0; c < 6; ++c) B(r, c) = row[c];
            for (std::size_t c = 0; c < m_free.size(); ++c)
                A(r, static_cast<Eigen::Index>(c)) = row[6 + m_free[c]];
        }
        const Eigen::MatrixXd cross = B.transpose() * A;
        m_sum += A.transpose() * A - cross.transpose() * (B.transpose() * B).ldlt().solve(cross);
    }

    /// [9x9], 0 where nothing was estimated.
    Eigen::Matrix<double, kIntrinsics, kIntrinsics> covariance(double variance) const {
        // Scaled to a diagonal of ones: k2 and fx differ by many powers of ten.
        const Eigen::VectorXd scale = m_sum.diagonal().cwiseSqrt().cwiseInverse();
        const Eigen::MatrixXd scaled = scale.asDiagonal() * m_sum * scale.asDiagonal();
        const Eigen::MatrixXd inverse =
            scale.asDiagonal() *
            scaled.ldlt().solve(Eigen::MatrixXd::Identity(m_sum.rows(), m_sum.cols())) *
            scale.asDiagonal();
        Eigen::Matrix<double, kIntrinsics, kIntrinsics> all;
        all.setZero();
        for (std::size_t r = 0; r < m_free.size(); ++r)
            for (std::size_t c = 0; c < m_free.size(); ++c)
                all(m_free[r], m_free[c]) =
                    variance * inverse(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c));
        return all;
    }

 private:
    std::vector<Eigen::Index> m_free;
    Eigen::MatrixXd m_sum;
};

void checkDetermined(const TCameraCalibration& result) {
    for (int i = 0; i < 2; ++i) {
        const double f = i == 0 ? result.camera.fx() : result.camera.fy();
        const double sigma = std::sqrt(result.covariance(i, i));
        if (!(f > 0) || !(sigma <= kWorstFocalSigma * f))
            throw std::runtime_error(
                "the pictures of the board do not determine a camera: show it from more and "
                "steeper sides (the focal length would be " +
                std::to_string(f) + " +- " + std::to_string(sigma) + " px)");
    }
}

void addFit(const std::vector<TPoint2D>& board,
            const std::vector<TBoardView>& views,
            const TSolution& found,
            const std::vector<Eigen::Index>& free,
            TCameraCalibration& result) {
    CInformation information(free);
    double squares = 0;
    for (std::size_t i = 0; i < views.size(); ++i) {
        std::vector<cv::Point2f> expected;
        cv::Mat jacobian;
        cv::projectPoints(onPlane(board), found.rotations[i], found.translations[i],
                          cameraMatrix(found.camera), distortionOf(found.camera), expected,
                          jacobian);
        information.add(jacobian);
        result.fitted.push_back(residualsOf(views[i].pixels, expected));
        squares += std::pow(result.fitted.back().rms, 2) * static_cast<double>(board.size());
        result.T_c_b.push_back(poseFrom(found.rotations[i], found.translations[i]));
    }
    const double freedom = 2.0 * static_cast<double>(board.size() * views.size()) -
                           static_cast<double>(free.size() + 6 * views.size());
    if (!(freedom > 0))
        throw std::runtime_error("the points of the board are too few to determine a camera");
    result.sigmaPixels = std::sqrt(squares / freedom);
    result.covariance = information.covariance(squares / freedom);
}

}  // namespace

void TCameraCalibrationOptions::visit(config::COptionVisitor& v) {
    v.integer("radial_terms", radialTerms, config::between(0, 3), "how many of k1, k2, k3");
    v.flag("tangential", tangential, "whether p1 and p2 are estimated");
    v.integer("folds", folds, config::between(2, 1000),
              "blocks of neighbouring pictures, each left out once");
}

double TCameraCalibration::rmsOf(const std::vector<TViewResiduals>& views) {
    double squares = 0, count = 0;
    for (const auto& view : views) {
        squares += std::pow(view.rms, 2) * static_cast<double>(view.errors.size());
        count += static_cast<double>(view.errors.size());
    }
    return count > 0 ? std::sqrt(squares / count) : 0;
}

CCameraCalibrator::CCameraCalibrator(const TCameraCalibrationOptions& options)
    : m_options(options) {
    m_options.validate();
}

TCameraCalibration CCameraCalibrator::calibrate(const std::vector<TPoint2D>& board,
                                                const std::vector<TBoardView>& views,
                                                const cv::Size& size) const {
    checkViews(board, views);
    TCameraCalibration result;
    const TSolution all = solve(board, views, size, m_options);
    result.camera = all.camera;
    addFit(board, views, all, freeOnes(m_options), result);
    checkDetermined(result);
    const std::size_t folds = std::min(views.size(), static_cast<std::size_t>(m_options.folds));
    if (views.size() - (views.size() + folds - 1) / folds < kLeastViews) return result;
    // Blocks of neighbours, since pictures taken one after the other are alike.
    const auto foldOf = [&](std::size_t i) { return i * folds / views.size(); };
    result.heldOut.resize(views.size());
    for (std::size_t fold = 0; fold < folds; ++fold) {
        std::vector<TBoardView> others;
        for (std::size_t i = 0; i < views.size(); ++i)
            if (foldOf(i) != fold) others.push_back(views[i]);
        const auto camera = solve(board, others, size, m_options).camera;
        for (std::size_t i = 0; i < views.size(); ++i) {
            if (foldOf(i) != fold) continue;
            const auto pose = locateBoard(camera, board, views[i].pixels);
            if (!pose) throw std::runtime_error(views[i].name + ": its points are no board");
            result.heldOut[i] = pose->residuals;
        }
    }
    return result;
}

std::optional<TBoardPose> locateBoard(const mrpt::img::TCamera& camera,
                                      const std::vector<TPoint2D>& board,
                                      const std::vector<TPoint2D>& pixels) {
    cv::Mat rotation, translation;
    std::vector<cv::Point2f> expected;
    const auto objects = onPlane(board);
    const auto K = cameraMatrix(camera);
    const auto distortion = distortionOf(camera);
    try {
        if (!cv::solvePnP(objects, asPixels(pixels), K, distortion, rotation, translation, false,
                          cv::SOLVEPNP_ITERATIVE))
            return std::nullopt;
        cv::solvePnPRefineLM(objects, asPixels(pixels), K, distortion, rotation, translation);
    } catch (const cv::Exception&) {
        return std::nullopt;
    }
    if (!(translation.at<double>(2) > 0)) return std::nullopt;
    cv::projectPoints(objects, rotation, translation, K, distortion, expected);
    return TBoardPose{poseFrom(rotation, translation), residualsOf(pixels, expected)};
}

}  // namespace salma::calibration
