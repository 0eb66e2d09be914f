// SPDX-License-Identifier: BSD-3-Clause
#include "CCaptureDisplay.h"

#include <mrpt/core/format.h>
#include <unistd.h>

#include <iostream>

namespace salma::apps {
namespace {

constexpr auto kRateWindow = std::chrono::seconds(5);
constexpr auto kRedraw = std::chrono::milliseconds(500);
constexpr auto kPlainLine = std::chrono::seconds(10);

const char* nameOf(CSensorThread::EPhase phase) {
    switch (phase) {
        case CSensorThread::EPhase::waiting:
            return "waiting";
        case CSensorThread::EPhase::starting:
            return "starting";
        case CSensorThread::EPhase::working:
            return "working";
        case CSensorThread::EPhase::failed:
            return "failed";
        case CSensorThread::EPhase::ended:
            return "ended";
    }
    return "";
}

}  // namespace

CCaptureDisplay::CCaptureDisplay()
    : m_terminal(isatty(STDERR_FILENO) != 0),
      m_start(TSteady::now()),
      m_next(m_start + (m_terminal ? kRedraw : kPlainLine)) {}

double CCaptureDisplay::rate(const CSensorThread& sensor,
                             std::size_t records,
                             TSteady::time_point now) {
    auto& counts = m_counts[&sensor];
    counts.push_back({now, records});
    while (counts.size() > 2 && now - counts[1].time > kRateWindow) counts.pop_front();
    const double seconds = std::chrono::duration<double>(now - counts.front().time).count();
    return seconds > 0 ? static_cast<double>(records - counts.front().records) / seconds : 0;
}

void CCaptureDisplay::update(const TSensors& sensors, std::uint64_t bytes) {
    const auto now = TSteady::now();
    if (now < m_next) return;
    m_next = now + (m_terminal ? std::chrono::milliseconds(kRedraw)
                               : std::chrono::milliseconds(kPlainLine));
    const double seconds = std::chrono::duration<double>(now - m_start).count();
    const double megabytes = static_cast<double>(bytes) / 1e6;
    std::vector<std::string> lines;
    std::string plain = mrpt::format("%.0f s, %.1f MB", seconds, megabytes);
    lines.push_back(plain);
    for (const auto& sensor : sensors) {
        const auto status = sensor->status();
        const double hertz = rate(*sensor, status.records, now);
        lines.push_back(mrpt::format("  %-16s %8zu  %7.1f Hz  last %6.2f s ago  %s",
                                     sensor->section().c_str(), status.records, hertz, status.age,
                                     nameOf(status.phase)));
        plain += mrpt::format("; %s %zu, %.1f Hz, last %.2f s ago%s", sensor->section().c_str(),
                              status.records, hertz, status.age,
                              status.phase == CSensorThread::EPhase::working
                                  ? ""
                                  : (std::string(", ") + nameOf(status.phase)).c_str());
    }
    if (m_terminal)
        draw(lines);
    else
        std::cerr << plain << std::endl;
}

void CCaptureDisplay::draw(const std::vector<std::string>& lines) {
    std::string text;
    if (m_drawn > 0) text = "\x1b[" + std::to_string(m_drawn) + "F";  // up, to the first column
    for (const auto& line : lines) text += line + "\x1b[K\n";
    std::cerr << text << std::flush;
    m_drawn = lines.size();
}

void CCaptureDisplay::tell(const std::string& line) {
    m_drawn = 0;  // the next drawing begins below this line
    std::cerr << line << std::endl;
}

void CCaptureDisplay::finish() { m_drawn = 0; }

}  // namespace salma::apps
