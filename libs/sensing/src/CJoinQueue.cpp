// SPDX-License-Identifier: BSD-3-Clause
#include <mrpt/core/Clock.h>
#include <salma/sensing/CJoinQueue.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace salma::sensing {
namespace {

using landmarks::EJoin;
using mrpt::obs::CObservation2DRangeScan;

constexpr double kHistory = 10;           // seconds
constexpr std::size_t kMostScans = 1000;  // of a laser whose clock stands still

double stampOf(const mrpt::obs::CObservation& observation) {
    return mrpt::Clock::toDouble(observation.timestamp);
}

EFate fateOf(EJoin join) {
    if (join == EJoin::noScan) return EFate::noScan;
    return join == EJoin::noHeadPose ? EFate::noHeadPose : EFate::joined;
}

}  // namespace

/// Keeps the newest stamp of a stream. False if it went back by more than `tolerance`: then the
/// observation begins a new time.
bool CJoinQueue::goesOn(Newest& newest,
                        const mrpt::obs::CObservation& observation,
                        double tolerance) {
    const double time = stampOf(observation);
    const bool onward = !newest || time >= *newest - tolerance;
    if (!onward) {
        ++m_jumps;
        giveUpWaiting();
        m_scans.clear();
        m_head = {};
        m_odometry = {};
        m_newestPicture = m_newestScan = m_newestHead = m_newestOdometry = std::nullopt;
    }
    newest = newest ? std::max(time, *newest) : time;
    return onward;
}

void CJoinQueue::giveUpWaiting() {
    for (auto& waiting : m_waiting) {
        TDecidedPicture decided;
        decided.job.picture = std::move(waiting.picture);
        decided.fate = EFate::clockJumped;
        m_givenUp.push_back(std::move(decided));
    }
    m_waiting.clear();
}

void CJoinQueue::add(const mrpt::obs::CObservationImage::Ptr& picture, double arrival) {
    // Cameras that save pictures in several threads deliver them a little out of order.
    goesOn(m_newestPicture, *picture, m_options.maxSkew);
    m_waiting.push_back({picture, stampOf(*picture) - m_options.latency, arrival});
}

void CJoinQueue::add(const CObservation2DRangeScan::Ptr& scan) {
    goesOn(m_newestScan, *scan, 0);
    m_scans.push_back(scan);
    if (m_scans.size() > kMostScans) m_scans.pop_front();
}

void CJoinQueue::add(const observations::CObservationPanTilt::Ptr& state) {
    goesOn(m_newestHead, *state, 0);
    m_lastHead = state;
    m_head.add(state);
}

void CJoinQueue::add(const mrpt::obs::CObservationOdometry::Ptr& odometry) {
    goesOn(m_newestOdometry, *odometry, 0);
    m_robot = odometry->odometry;
    m_odometry.add(*m_newestOdometry, *m_robot);
}

bool CJoinQueue::isReady(const TWaiting& waiting, double now) const {
    return isKnown(waiting.time) || !(now - waiting.arrival < m_options.wait);
}

/// All that a picture of that `time` is joined with has come.
bool CJoinQueue::isKnown(double time) const {
    const auto reaches = [](const Newest& newest, double t) { return newest && *newest >= t; };
    if (!reaches(m_newestScan, time)) return false;
    if (m_options.hasHead && !reaches(m_newestHead, time)) return false;
    // The motion goes on to the scan, which may be the younger of the two.
    const double end = std::max(time, stampOf(*nearestScan(time)));
    return !m_options.hasOdometry || reaches(m_newestOdometry, end);
}

CObservation2DRangeScan::Ptr CJoinQueue::nearestScan(double time) const {
    CObservation2DRangeScan::Ptr best;
    for (const auto& scan : m_scans)
        if (!best || std::abs(stampOf(*scan) - time) < std::abs(stampOf(*best) - time)) best = scan;
    return best;
}

TDecidedPicture CJoinQueue::decide(const TWaiting& waiting) const {
    TDecidedPicture decided;
    decided.job.picture = waiting.picture;
    decided.job.scan = nearestScan(waiting.time);
    decided.fate = fateOf(landmarks::joinPicture(
        decided.job, {m_odometry, m_head, waiting.time, m_options.maxSkew, false}));
    // A head that has not answered yet is not a camera that is fixed.
    if (m_options.hasHead && m_head.empty() && decided.fate == EFate::joined)
        decided.fate = EFate::noHeadPose;
    decided.T_o_r = m_odometry.at(waiting.time, m_options.maxSkew);
    return decided;
}

std::vector<TDecidedPicture> CJoinQueue::take(double now) {
    std::vector<TDecidedPicture> out = std::exchange(m_givenUp, {});
    while (!m_waiting.empty() &&
           (m_waiting.size() > kMostPictures || isReady(m_waiting.front(), now))) {
        out.push_back(decide(m_waiting.front()));
        m_waiting.pop_front();
    }
    forget();
    return out;
}

/// What is older than all pictures that may come or that wait.
void CJoinQueue::forget() {
    const auto before = [&](const Newest& newest) {
        double time = *newest;
        for (const auto& waiting : m_waiting) time = std::min(time, waiting.time);
        return time - kHistory;
    };
    if (m_newestHead) m_head.forgetBefore(before(m_newestHead));
    if (m_newestOdometry) m_odometry.forgetBefore(before(m_newestOdometry));
    while (!m_scans.empty() && stampOf(*m_scans.front()) < before(m_newestScan))
        m_scans.pop_front();
}

}  // namespace salma::sensing
