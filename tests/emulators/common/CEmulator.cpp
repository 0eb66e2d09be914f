// SPDX-License-Identifier: BSD-3-Clause
#include "CEmulator.h"

#include <chrono>

namespace salma::test {

CEmulator::CEmulator(CEmulatedDevice& device, const std::string& link)
    : m_device(device), m_terminal(link), m_thread([this] { run(); }) {}

CEmulator::~CEmulator() {
    m_stop = true;
    m_thread.join();
}

void CEmulator::locked(const std::function<void()>& body) {
    const std::lock_guard<std::mutex> lock(m_mutex);
    body();
}

void CEmulator::unplug() {
    locked([this] {
        m_terminal.unplug();
        m_toDevice = m_toComputer = {};
    });
}

void CEmulator::plug() {
    locked([this] { m_terminal.plug(); });
}

double CEmulator::now() {
    return std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch())
        .count();
}

void CEmulator::run() {
    while (!m_stop) {
        {
            const std::lock_guard<std::mutex> lock(m_mutex);
            const int baud = m_terminal.baud();
            m_toDevice.put(m_terminal.read(0), now(), baud);
            const TBytes heard = m_toDevice.take(now());
            if (!heard.empty()) m_device.receive(heard, baud, now());
            const int rate = m_device.baud() > 0 ? m_device.baud() : baud;
            m_toComputer.put(m_device.transmit(now()), now(), rate);
            m_terminal.write(m_toComputer.take(now(), baud));
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

}  // namespace salma::test
