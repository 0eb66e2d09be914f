// SPDX-License-Identifier: BSD-3-Clause
#include "CViscaLink.h"

#include <mrpt/core/Clock.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace salma::drivers {
namespace {

using visca::bufferFull, visca::cancelled, visca::noSocket, visca::notExecutable,
    visca::syntaxError;

double steadyNow() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// A flag that is up as long as this lives.
class CRaised {
 public:
    explicit CRaised(bool& flag) : m_flag(flag) { m_flag = true; }
    ~CRaised() { m_flag = false; }
    CRaised(const CRaised&) = delete;
    CRaised& operator=(const CRaised&) = delete;

 private:
    bool& m_flag;
};

std::string meaning(int code) {
    switch (code) {
        case 0:
            return "no answer";
        case syntaxError:
            return "syntax error (02)";
        case bufferFull:
            return "its buffer is full (03)";
        case cancelled:
            return "the command was cancelled (04)";
        case noSocket:
            return "no such socket (05)";
        case notExecutable:
            return "not executable in its present state (41)";
        default:
            return "unknown error " + std::to_string(code);
    }
}

}  // namespace

CViscaLink::CViscaLink(const std::string& port, const TViscaOptions& options)
    : m_options(options), m_line(port, options.baud) {
    initialise();
}

void CViscaLink::initialise() {
    const CRaised initialising(m_initialising);
    m_parser.reset();
    m_running.clear();
    const auto counted = inquire(visca::addressSet(), [](const TViscaReply& reply) {
        return reply.kind == EViscaReply::addressSet;
    });
    const int cameras = counted.reply.data[0] - 1;
    if (cameras < m_options.address)
        throw CViscaError(m_line.port() + ": there is no camera " +
                              std::to_string(m_options.address) + " in a chain of " +
                              std::to_string(cameras),
                          0);
    inquire(visca::interfaceClear(m_options.address), [](const TViscaReply& reply) {
        return reply.kind == EViscaReply::completion && reply.socket == 0;
    });
    m_mustInitialise = false;
}

TViscaAnswer CViscaLink::inquire(const visca::TPacket& question,
                                 const std::function<bool(const TViscaReply&)>& good,
                                 bool fresh) {
    int refusal = 0;
    for (int tries = 0; tries <= m_options.retries; ++tries) {
        refusal = 0;
        if (fresh && m_lateAnswers && !skipLateAnswers()) continue;
        TViscaAnswer answer = send(question);
        while (refusal == 0) {
            auto reply = nextAnswer();
            if (!reply) break;
            if (good(*reply)) {
                answer.reply = std::move(*reply);
                return answer;
            }
            if (reply->kind == EViscaReply::error) refusal = reply->error;
        }
        if (refusal == 0) m_lateAnswers = true;
        handleRefusal(refusal);
    }
    fail(refusal);
}

bool CViscaLink::skipLateAnswers() {
    send(visca::zoomInquiry(m_options.address));  // answered after all that was asked before
    while (const auto reply = nextAnswer())
        if (reply->kind == EViscaReply::information && visca::decodeZoom(reply->data)) {
            m_lateAnswers = false;
            return true;
        }
    return false;
}

void CViscaLink::start(const visca::TPacket& command, bool repeatable) {
    int refusal = 0;
    for (int tries = 0; tries <= m_options.retries; ++tries) {
        send(command);
        refusal = 0;
        while (refusal == 0) {
            const auto reply = nextAnswer();
            if (!reply) break;
            if (reply->kind == EViscaReply::acknowledge) {
                m_running.insert(reply->socket);
                return;
            }
            if (reply->kind == EViscaReply::error) refusal = reply->error;
        }
        if (refusal == 0 && !repeatable) break;
        handleRefusal(refusal);
    }
    fail(refusal);
}

void CViscaLink::handleRefusal(int code) {
    if (code == bufferFull)
        waitForEnd(m_options.replyTimeout);
    else if (code != 0 && code != syntaxError)  // noise on the line makes syntax errors
        fail(code);
}

void CViscaLink::cancelAll() {
    const auto sockets = m_running;
    for (const int socket : sockets) {
        send(visca::cancel(m_options.address, socket));
        while (m_running.count(socket) > 0 && steadyNow() < m_deadline)
            listen(m_deadline - steadyNow());
    }
    m_failures.clear();
    m_running.clear();
}

bool CViscaLink::waitForEnd(double timeout) {
    const auto before = m_running.size();
    const double deadline = steadyNow() + timeout;
    while (m_running.size() == before) {
        const double left = deadline - steadyNow();
        if (!(left > 0)) return false;
        listen(left);
    }
    return true;
}

std::vector<int> CViscaLink::takeFailures() { return std::exchange(m_failures, {}); }

TViscaAnswer CViscaLink::send(const visca::TPacket& packet) {
    if (m_mustInitialise && !m_initialising) initialise();
    constexpr int patience = 64;  // a port that never stops sending must not hold us for ever
    for (int i = 0; i < patience && listen(0); ++i)
        ;
    m_answers.clear();  // late ones, to questions that were given up
    TViscaAnswer answer;
    answer.asked = mrpt::Clock::nowDouble();
    m_line.write(packet);
    answer.sent = mrpt::Clock::nowDouble();
    m_deadline = steadyNow() + m_options.replyTimeout;
    return answer;
}

bool CViscaLink::listen(double timeout) {
    const auto bytes = m_line.read(timeout);
    if (bytes.empty()) return false;
    for (auto& reply : m_parser.push(bytes.data(), bytes.size(), mrpt::Clock::nowDouble()))
        sort(std::move(reply));
    return true;
}

void CViscaLink::sort(TViscaReply reply) {
    if (reply.kind != EViscaReply::addressSet && reply.address != m_options.address) return;
    const bool ofRunning = m_running.count(reply.socket) > 0;
    if (reply.kind == EViscaReply::networkChange) {
        m_mustInitialise = true;
    } else if (reply.kind == EViscaReply::completion && (ofRunning || reply.socket != 0)) {
        m_running.erase(reply.socket);
    } else if (reply.kind == EViscaReply::error && ofRunning) {
        m_running.erase(reply.socket);
        if (reply.error != noSocket) m_failures.push_back(reply.error);
    } else if (reply.kind != EViscaReply::error ||
               (reply.error != cancelled && reply.error != noSocket)) {
        m_answers.push_back(std::move(reply));  // else: end of a command that we do not know
    }
}

std::optional<TViscaReply> CViscaLink::nextAnswer() {
    while (m_answers.empty()) {
        const double left = m_deadline - steadyNow();
        if (!(left > 0)) return std::nullopt;
        listen(left);
    }
    TViscaReply reply = std::move(m_answers.front());
    m_answers.pop_front();
    return reply;
}

void CViscaLink::fail(int code) {
    if (code == 0) m_mustInitialise = true;  // it may have been switched off and on
    throw CViscaError(
        m_line.port() + ": camera " + std::to_string(m_options.address) + ": " + meaning(code),
        code);
}

}  // namespace salma::drivers
