// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

#include "CPseudoTerminal.h"
#include "CWire.h"

namespace salma::test {

/// What a device does with bytes and time; knows nothing of cables. Times are seconds of the
/// system's clock.
class CEmulatedDevice {
 public:
    virtual ~CEmulatedDevice() = default;
    /// `baud` is that of the computer's end.
    virtual void receive(const TBytes& bytes, int baud, double now) = 0;
    /// What the device has to say by now.
    virtual TBytes transmit(double now) = 0;
    /// Rate that it transmits with; 0: that of the computer's end.
    virtual int baud() const { return 0; }
};

/// Runs a device at the end of a cable, in a thread of its own, until destroyed. Bytes take the
/// time that the line's rate gives them, both ways.
class CEmulator {
 public:
    /// \param device Must outlive this object; touch it through locked() only.
    CEmulator(CEmulatedDevice& device, const std::string& link);
    ~CEmulator();
    CEmulator(const CEmulator&) = delete;
    CEmulator& operator=(const CEmulator&) = delete;

    /// Calls `body` while the device stands still.
    void locked(const std::function<void()>& body);

    void unplug();
    void plug();

    static double now();

 private:
    void run();

    CEmulatedDevice& m_device;
    CPseudoTerminal m_terminal;
    CWire m_toDevice, m_toComputer;
    std::mutex m_mutex;
    std::atomic<bool> m_stop{false};
    std::thread m_thread;
};

}  // namespace salma::test
