// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <salma/drivers/CSerialLine.h>
#include <salma/drivers/CViscaError.h>
#include <salma/drivers/CViscaParser.h>
#include <salma/drivers/TViscaOptions.h>
#include <salma/drivers/viscaPackets.h>

#include <deque>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace salma::drivers {

/// An answer and when it was asked for, by mrpt::Clock [s].
struct TViscaAnswer {
    TViscaReply reply;
    double asked{0};  //!< Before the first byte of the question went; `reply.began` is the end.
    double sent{0};   //!< After its last byte had gone.
};

/** Questions and commands to one camera: time-outs, retries, and who sits in which socket.
 *
 * A command that the camera acknowledged runs in one of its sockets until it reports completion or
 * an error for that socket. Those reports come at any time, also between a question and its
 * answer. */
class CViscaLink {
 public:
    /// Opens the port, numbers the chain and clears the camera's buffers.
    /// \throw CPortError, CViscaError
    CViscaLink(const std::string& port, const TViscaOptions& options);

    /** Asks until an answer satisfies `good`.
     * \param fresh The answer must be to this question: not a late one to an earlier, which looks
     * the same.
     * \throw CPortError, CViscaError */
    TViscaAnswer inquire(const visca::TPacket& question,
                         const std::function<bool(const TViscaReply&)>& good,
                         bool fresh = false);

    /** Starts a command.
     * \param repeatable False if doing it twice would be wrong: then it is sent again only after a
     * refusal, never after silence.
     * \throw CPortError, CViscaError */
    void start(const visca::TPacket& command, bool repeatable);

    /// Asks the camera to give up all that it works on.
    void cancelAll();

    bool isBusy() const { return !m_running.empty(); }
    /// Listens until a command ends, at most `timeout` [s]. False: none ended.
    bool waitForEnd(double timeout);
    /// Error codes of commands that ended with one since the last call.
    std::vector<int> takeFailures();
    /// Takes all that runs for done: their reports got lost.
    void forgetRunning() { m_running.clear(); }

    /// \throw CViscaError that says what `code` means.
    [[noreturn]] void fail(int code);

    const std::string& port() const { return m_line.port(); }
    const TViscaParserCounts& counts() const { return m_parser.counts(); }

 private:
    void initialise();
    TViscaAnswer send(const visca::TPacket& packet);
    /// Reads for at most `timeout` [s] and sorts what came. False: nothing came.
    bool listen(double timeout);
    void sort(TViscaReply reply);
    /// The next answer to what was sent, waiting until the reply time is over.
    std::optional<TViscaReply> nextAnswer();
    /// Takes late answers off the line. False: no answer to that either.
    bool skipLateAnswers();
    /// Waits a little where that helps. \throw CViscaError where repeating does not help.
    void handleRefusal(int code);

    TViscaOptions m_options;
    CSerialLine m_line;
    CViscaParser m_parser;
    std::deque<TViscaReply> m_answers;  //!< Not yet looked at.
    std::set<int> m_running;            //!< Sockets at work.
    std::vector<int> m_failures;
    double m_deadline{0};  //!< Of the answer to what was sent last, by the steady clock [s].
    bool m_mustInitialise{true};
    bool m_initialising{false};
    bool m_lateAnswers{false};  //!< Something was not answered in time and may be yet.
};

}  // namespace salma::drivers
