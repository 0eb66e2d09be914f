// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <deque>
#include <optional>
#include <random>

#include "CEmulator.h"
#include "CMotor.h"

namespace salma::test {

/// What goes wrong with one packet that comes in.
enum class EFault {
    none,
    deaf,           //!< It was not heard at all.
    noAck,          //!< Carried out, but the acknowledgement gets lost.
    noCompletion,   //!< Carried out, but the completion gets lost.
    cutAnswer,      //!< The answer ends in the middle.
    lateAnswer,     //!< The answer, and all behind it, comes 0.4 s late.
    garbage,        //!< Noise stands before the answer.
    bufferFull,     //!< Refused with error 03.
    syntaxError,    //!< Refused with error 02.
    notExecutable,  //!< Refused with error 41.
    jam             //!< Carried out, but the motors stop half way and nothing is reported.
};

/** Sony's EVI-D30 as seen through its serial port.
 *
 * 9600 baud, two sockets, pan and tilt at 3.33 and 2.5 deg/s per step of the speed byte, zoom in
 * about three seconds. It has no address until it is told one, answers inquiries at once, and
 * carries out a new pan/tilt command in place of a running one (whose socket is then cancelled).
 * What is not in Sony's list (that last point, and error 41 beyond the ends) is a guess. */
class CEviD30 : public CEmulatedDevice {
 public:
    void receive(const TBytes& bytes, int baud, double now) override;
    TBytes transmit(double now) override;

    /// For the next packets, one each.
    void misbehave(std::deque<EFault> faults) { m_faults = std::move(faults); }
    /// Hears nothing, as without power, until woken; forgets its address.
    void sleep(bool asleep);
    /// As after switching on in a chain: it forgets its address and reports a network change.
    void restart();

    /// Somebody else turns it, as with its remote control: there it stands [deg], left and up.
    void turnTo(double pan, double tilt, double now);

    const CMotor& pan() const { return m_pan; }
    const CMotor& tilt() const { return m_tilt; }
    const CMotor& zoom() const { return m_zoom; }
    int packets() const { return m_packets; }  //!< That were for this camera and whole.
    int inquiries() const { return m_inquiries; }
    int motions() const { return m_motions; }  //!< Commands that set a motor going.

 private:
    struct TJob {
        bool head{false};  //!< Pan and tilt; else zoom.
        bool mute{false};  //!< Its completion gets lost.
    };

    void handle(const TBytes& packet, double now);
    void handleBroadcast(const TBytes& packet);
    void handleCommand(const TBytes& packet, EFault fault, double now);
    void handleInquiry(const TBytes& packet, EFault fault, double now);
    void cancel(int socket, double now);
    bool drive(const TBytes& packet, double now);
    void runHead(double pan, double tilt, int panSpeed, int tiltSpeed, double now);
    void begin(bool head, EFault fault, double now);
    void say(TBytes answer, EFault fault = EFault::none);

    int m_address{0};
    bool m_asleep{false};
    CMotor m_pan, m_tilt, m_zoom;
    std::array<std::optional<TJob>, 2> m_sockets;
    std::deque<EFault> m_faults;
    TBytes m_in, m_out;
    double m_silentUntil{0};  //!< What it has to say waits so long.
    std::mt19937 m_random{1};
    int m_packets{0}, m_inquiries{0}, m_motions{0};
};

}  // namespace salma::test
