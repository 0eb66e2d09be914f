// SPDX-License-Identifier: BSD-3-Clause
#include <salma/sensing/CFrontEndWorker.h>

#include <exception>
#include <stdexcept>
#include <utility>

namespace salma::sensing {
namespace {

/// As many finished pictures may wait to be taken; until then no further ones are begun.
constexpr std::size_t kMostFinished = 20;

void requireIntrinsics(const mrpt::img::TCamera& camera) {
    if (!(camera.fx() > 0 && camera.fy() > 0))
        throw std::invalid_argument("it has no focal length; set camera_params");
}

}  // namespace

CFrontEndWorker::CFrontEndWorker(const landmarks::TRecorderOptions& options,
                                 std::string imagesFolder,
                                 std::size_t threads)
    : m_recorder(options), m_imagesFolder(std::move(imagesFolder)) {
    for (std::size_t i = 0; i < threads; ++i) m_threads.emplace_back([this] { run(); });
}

CFrontEndWorker::~CFrontEndWorker() {
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        m_stop = true;
    }
    m_news.notify_all();
    for (auto& thread : m_threads) thread.join();
}

bool CFrontEndWorker::offer(TDecidedPicture picture) {
    bool isFree = false;
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        isFree = !m_waiting;
        m_waiting = std::move(picture);
    }
    m_news.notify_one();
    return isFree;
}

std::vector<TWorkedPicture> CFrontEndWorker::take() {
    std::vector<TWorkedPicture> out;
    {
        const std::lock_guard<std::mutex> lock(m_mutex);
        out.swap(m_finished);
    }
    m_news.notify_all();
    return out;
}

bool CFrontEndWorker::isIdle() const {
    const std::lock_guard<std::mutex> lock(m_mutex);
    return !m_waiting && m_inWork == 0 && m_finished.empty();
}

void CFrontEndWorker::run() {
    std::unique_lock<std::mutex> lock(m_mutex);
    while (true) {
        m_news.wait(lock,
                    [this] { return m_stop || (m_waiting && m_finished.size() < kMostFinished); });
        if (m_stop) return;
        TDecidedPicture picture = std::move(*m_waiting);
        m_waiting.reset();
        ++m_inWork;
        lock.unlock();
        TWorkedPicture worked = work(std::move(picture));
        lock.lock();
        --m_inWork;
        m_finished.push_back(std::move(worked));
    }
}

TWorkedPicture CFrontEndWorker::work(TDecidedPicture picture) const {
    TWorkedPicture worked;
    try {
        requireIntrinsics(picture.job.picture->cameraParams);
        worked.recorded = m_recorder.record(picture.job, m_imagesFolder);
    } catch (const std::exception& error) {  // one bad picture does not end a drive
        worked.recorded = {};
        worked.error = error.what();
    }
    worked.picture = std::move(picture);
    return worked;
}

}  // namespace salma::sensing
