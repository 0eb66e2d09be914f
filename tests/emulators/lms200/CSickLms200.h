// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <deque>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "CEmulator.h"

namespace salma::test {

/// What goes wrong with one command or its answer.
enum class ELmsFault {
    none,
    deaf,           //!< It was not heard at all.
    noAcknowledge,  //!< Carried out, but the acknowledgement gets lost.
    noAnswer,       //!< Acknowledged and carried out, but the answer gets lost.
    refusal,        //!< Not carried out: NAK.
    wrongChecksum,  //!< Of the answer.
    cutTelegram,    //!< The answer ends in the middle.
    noise,          //!< Random bytes stand before the answer.
    absurdLength    //!< A header that announces 65535 bytes stands before the answer.
};

/// How a scan is asked for.
struct TLmsView {
    int aperture{180};   //!< 100 or 180 [deg].
    int resolution{50};  //!< 25, 50 or 100 [1/100 deg].
    std::size_t beams() const { return static_cast<std::size_t>(aperture * 100 / resolution) + 1; }
    /// Between two scans [s]: one, two or four turns of the mirror.
    double period() const {
        return resolution == 100 ? 1 / 75.0 : resolution == 50 ? 2 / 75.0 : 4 / 75.0;
    }
};

/// Ranges [m] of the beams from right to left; infinity where nothing is hit.
using TLmsScanner = std::function<std::vector<double>(const TLmsView& view, double now)>;

/** A SICK LMS 200 as seen through its serial port.
 *
 * It starts at 9600 baud and waits for commands; knows 10 (reset), 20 (modes, baud rates), 30, 31,
 * 32, 3A, 3B, 42, 74 and 77, refuses others, and wants the password where the real one does. Scans
 * follow each other as fast as mirror and line allow. Source: SICK, "Telegrams for configuring and
 * operating the LMS 2xx"; that unknown commands get a NAK, and the texts of 31 and 32, are guesses.
 */
class CSickLms200 : public CEmulatedDevice {
 public:
    explicit CSickLms200(TLmsScanner scanner) : m_scanner(std::move(scanner)) {}

    void receive(const TBytes& bytes, int baud, double now) override;
    TBytes transmit(double now) override;
    int baud() const override { return m_baud; }

    /// For the next commands, one each.
    void misbehave(std::deque<ELmsFault> faults) { m_faults = std::move(faults); }
    /// For the next scans of the stream, one each.
    void spoilScans(std::deque<ELmsFault> faults) { m_scanFaults = std::move(faults); }
    /// Without power: neither hears nor says anything until woken, and then starts anew.
    void sleep(bool asleep);
    /// Streams on, but nothing reaches the line.
    void silence(bool silent) { m_silent = silent; }
    /// Variants (3B) are refused from now on, as where somebody else's password is needed.
    void holdView(bool held) { m_viewHeld = held; }

    const TLmsView& view() const { return m_view; }
    bool streaming() const { return m_streaming; }
    bool millimetres() const { return m_config[unitByte] == 1; }
    int scans() const { return m_scans; }        //!< Streamed, spoilt ones too.
    int commands() const { return m_commands; }  //!< Heard, whole and for it.

 private:
    static constexpr std::size_t modeByte = 5, unitByte = 6;  // of the configuration

    void restart();
    bool takeTelegram(double now);
    void handle(const TBytes& content, double now);
    void changeMode(const TBytes& content, ELmsFault fault, double now);
    void answer(TBytes content, ELmsFault fault = ELmsFault::none);
    void send(const TBytes& content, ELmsFault fault);
    TBytes scanContent(double now);
    bool passwordIn(const TBytes& content) const;

    TLmsScanner m_scanner;
    TLmsView m_view;
    std::array<std::uint8_t, 34> m_config{{0, 0, 70, 0, 0, 0, 1, 0, 0, 2}};
    std::string m_password{"SICK_LMS"};
    bool m_asleep{false}, m_silent{false}, m_viewHeld{false};
    bool m_streaming{false}, m_installing{false}, m_restarts{false};
    int m_baud{9600}, m_nextBaud{9600};
    double m_nextScan{0}, m_lineFree{0};
    TBytes m_in, m_out;
    std::deque<ELmsFault> m_faults, m_scanFaults;
    std::mt19937 m_random{1};
    int m_scans{0}, m_commands{0};
};

}  // namespace salma::test
