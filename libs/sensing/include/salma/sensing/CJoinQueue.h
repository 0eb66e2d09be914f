// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <mrpt/obs/CObservationOdometry.h>
#include <salma/landmarks/joinPicture.h>

#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

namespace salma::sensing {

/// What became of a picture.
enum class EFate { joined, noScan, noHeadPose, clockJumped };

/// A picture that waits no longer.
struct TDecidedPicture {
    landmarks::TJoinedPicture job;  //!< Whole if it was joined, else the picture alone.
    EFate fate{EFate::joined};
    std::optional<mrpt::poses::CPose2D> T_o_r;  //!< By odometry at the picture's time.
};

struct TJoinQueueOptions {
    bool hasHead{false};      //!< Pictures wait for its state ...
    bool hasOdometry{false};  //!< ... and for odometry.
    double maxSkew{0.25};     //!< TFrontEndOptions::maxSkew [s].
    double latency{0};        //!< TFrontEndOptions::latencyCamera [s].
    double wait{0.5};         //!< Longest wait of a picture after its arrival [s].
};

/** Pictures that wait for what was seen and driven around their time.
 *
 * A picture is decided when a scan, a head state and an odometry record that are not older have
 * come, or when it has waited long enough; so it is joined with the same scan and poses as off
 * line, where the whole log is known. Every picture comes out once. A stamp that goes back tells of
 * a clock that was set: what was known is forgotten and waiting pictures are given up. Of each
 * stream the last seconds are kept, and at most `kMostPictures` pictures. Not thread-safe. */
class CJoinQueue {
 public:
    static constexpr std::size_t kMostPictures = 50;

    explicit CJoinQueue(const TJoinQueueOptions& options) : m_options(options) {}

    /// \param arrival By a clock that is never set [s].
    void add(const mrpt::obs::CObservationImage::Ptr& picture, double arrival);
    void add(const mrpt::obs::CObservation2DRangeScan::Ptr& scan);
    void add(const observations::CObservationPanTilt::Ptr& state);
    void add(const mrpt::obs::CObservationOdometry::Ptr& odometry);

    /// The pictures that are decided, in the order of their arrival. \param now As `arrival`.
    std::vector<TDecidedPicture> take(double now);

    bool empty() const { return m_waiting.empty() && m_givenUp.empty(); }

    /// The last known pose of the robot by odometry.
    std::optional<mrpt::poses::CPose2D> robot() const { return m_robot; }
    /// The last known state of the head; null before the first.
    const observations::CObservationPanTilt::Ptr& head() const { return m_lastHead; }
    /// Times that a clock went back.
    std::size_t jumps() const { return m_jumps; }

 private:
    struct TWaiting {
        mrpt::obs::CObservationImage::Ptr picture;
        double time{0};  //!< At which it was taken [s].
        double arrival{0};
    };
    /// Newest stamp of a stream [s]; nothing before the first.
    using Newest = std::optional<double>;

    bool goesOn(Newest& newest, const mrpt::obs::CObservation& observation, double tolerance);
    bool isReady(const TWaiting& waiting, double now) const;
    bool isKnown(double time) const;
    TDecidedPicture decide(const TWaiting& waiting) const;
    mrpt::obs::CObservation2DRangeScan::Ptr nearestScan(double time) const;
    void giveUpWaiting();
    void forget();

    TJoinQueueOptions m_options;
    std::deque<TWaiting> m_waiting;
    std::vector<TDecidedPicture> m_givenUp;
    std::deque<mrpt::obs::CObservation2DRangeScan::Ptr> m_scans;
    observations::CPanTiltHistory m_head;
    observations::CPoseHistory m_odometry;
    Newest m_newestPicture, m_newestScan, m_newestHead, m_newestOdometry;
    std::optional<mrpt::poses::CPose2D> m_robot;
    observations::CObservationPanTilt::Ptr m_lastHead;
    std::size_t m_jumps{0};
};

}  // namespace salma::sensing
