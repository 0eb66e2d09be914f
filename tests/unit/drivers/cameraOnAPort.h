// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <gtest/gtest.h>
#include <salma/drivers/CViscaCamera.h>

#include "CEviD30.h"
#include "CTemporaryFolder.h"

namespace salma::test {

/// An emulated camera at the end of a pseudo-terminal.
class CameraOnAPort : public testing::Test {
 protected:
    std::string port() const { return (m_folder / "camera").string(); }

    static drivers::TViscaOptions quick() {
        drivers::TViscaOptions options;
        options.replyTimeout = 0.25;  // long for a pseudo-terminal, so that a busy machine will do
        options.stallTime = 0.2;
        return options;
    }

    void misbehave(const std::deque<EFault>& faults) {
        m_emulator.locked([&] { m_device.misbehave(faults); });
    }

    double truePan() {
        double pan = 0;
        m_emulator.locked([&] { pan = m_device.pan().at(CEmulator::now()); });
        return pan;
    }
    double trueTilt() {
        double tilt = 0;
        m_emulator.locked([&] { tilt = m_device.tilt().at(CEmulator::now()); });
        return tilt;
    }
    int motions() {
        int motions = 0;
        m_emulator.locked([&] { motions = m_device.motions(); });
        return motions;
    }

    CTemporaryFolder m_folder;
    CEviD30 m_device;
    CEmulator m_emulator{m_device, port()};
};

}  // namespace salma::test
