// SPDX-License-Identifier: BSD-3-Clause
// The driver against a camera and a cable that misbehave.
#include <mrpt/core/bits_math.h>
#include <salma/drivers/CSerialLine.h>

#include <random>

#include "cameraOnAPort.h"

using namespace salma;
using drivers::CPortError;
using drivers::CViscaCamera;
using drivers::CViscaError;
using mrpt::DEG2RAD;
using mrpt::RAD2DEG;
using test::EFault;

namespace {

using ViscaFaults = test::CameraOnAPort;

/// Code of the CViscaError that `call` throws; -1 if it throws none.
template <class CALL>
int codeOf(CALL call) {
    try {
        call();
    } catch (const CViscaError& error) {
        return error.code();
    }
    return -1;
}

}  // namespace

TEST_F(ViscaFaults, WhatIsNotAnsweredIsAskedAgain) {
    CViscaCamera camera(port(), quick());
    misbehave({EFault::deaf, EFault::deaf, EFault::deaf});
    EXPECT_NEAR(camera.panTilt().pan, 0, 1e-12);
    misbehave({EFault::deaf});
    camera.moveTo(DEG2RAD(2.0), 0);
    camera.wait();
    EXPECT_NEAR(truePan(), 18, 1e-9);
}

TEST_F(ViscaFaults, AnAbsoluteMoveIsRepeatedWhenItsAcknowledgementIsLost) {
    CViscaCamera camera(port(), quick());
    misbehave({EFault::noAck});
    camera.moveTo(DEG2RAD(10.0), 0, DEG2RAD(20.0));
    camera.wait();
    EXPECT_NEAR(truePan(), 88, 1e-9);
    EXPECT_EQ(motions(), 2);
}

TEST_F(ViscaFaults, ARelativeMoveIsNeverDoneTwice) {
    CViscaCamera camera(port(), quick());
    misbehave({EFault::none, EFault::noAck});  // the first is the question where the head stands
    EXPECT_EQ(codeOf([&] { camera.moveBy(DEG2RAD(5.0), 0); }), 0);
    EXPECT_EQ(motions(), 1);
    misbehave({EFault::none, EFault::syntaxError});  // refused, so certainly not done
    const double before = RAD2DEG(camera.panTilt().pan);
    misbehave({EFault::none, EFault::syntaxError});
    camera.moveBy(DEG2RAD(5.0), 0);
    camera.wait();
    EXPECT_GT(RAD2DEG(camera.panTilt().pan), before);
    EXPECT_EQ(motions(), 2);
}

TEST_F(ViscaFaults, RefusalsForNowAreRepeatedOthersAreReported) {
    CViscaCamera camera(port(), quick());
    misbehave({EFault::bufferFull, EFault::syntaxError});
    camera.moveTo(DEG2RAD(3.0), 0);
    camera.wait();
    EXPECT_NEAR(truePan(), 26, 1e-9);
    misbehave({EFault::notExecutable});
    EXPECT_EQ(codeOf([&] { camera.moveTo(0, 0); }), 0x41);
    misbehave({EFault::notExecutable});
    EXPECT_EQ(codeOf([&] { camera.panTilt(); }), 0x41);
    misbehave({EFault::bufferFull, EFault::bufferFull, EFault::bufferFull, EFault::bufferFull});
    EXPECT_EQ(codeOf([&] { camera.moveTo(0, 0); }), 0x03);
    misbehave({EFault::syntaxError, EFault::syntaxError, EFault::syntaxError, EFault::syntaxError});
    EXPECT_EQ(codeOf([&] { camera.panTilt(); }), 0x02);
    EXPECT_NO_THROW(camera.panTilt());
}

TEST_F(ViscaFaults, CutAnswersAndNoiseAreSurvived) {
    CViscaCamera camera(port(), quick());
    camera.moveTo(DEG2RAD(5.0), DEG2RAD(5.0));
    camera.wait();
    for (const EFault fault : {EFault::cutAnswer, EFault::garbage}) {
        misbehave({fault, fault});
        const auto state = camera.panTilt();
        EXPECT_NEAR(RAD2DEG(state.pan), 5, 1e-9);
        EXPECT_NEAR(RAD2DEG(state.tilt), 5, 1e-9);
        misbehave({fault});
        EXPECT_NEAR(camera.zoom(), 1, 1e-12);
    }
}

TEST_F(ViscaFaults, ALateAnswerIsNotTakenForAFreshOne) {
    CViscaCamera camera(port(), quick());
    const double speed = DEG2RAD(20.0);
    camera.moveTo(DEG2RAD(60.0), 0, speed);
    misbehave({EFault::lateAnswer});
    for (int i = 0; i < 5; ++i) {
        const auto state = camera.panTilt();
        double truth = 0;
        m_emulator.locked([&] { truth = m_device.pan().at(state.time); });
        const double slack = RAD2DEG(speed * state.uncertainty) * 8.8 + 0.5 + 1e-3;
        EXPECT_NEAR(RAD2DEG(state.pan) * 8.8, truth, slack);
    }
    camera.stop();
}

TEST(ViscaNoise, ADeviceThatNeverStopsTalkingIsGivenUp) {
    /// Says the same for ever, or noise.
    class CBabbler : public test::CEmulatedDevice {
     public:
        explicit CBabbler(test::TBytes text) : m_text(std::move(text)) {}
        void receive(const test::TBytes&, int, double) override {}
        test::TBytes transmit(double) override {
            if (m_text.empty()) return {static_cast<std::uint8_t>(m_random())};
            return m_text;
        }

     private:
        test::TBytes m_text;
        std::mt19937 m_random{20043};
    };
    auto options = drivers::TViscaOptions();
    options.retries = 1;
    for (const auto& text :
         {test::TBytes{}, test::TBytes{0x90, 0x38, 0xFF}, test::TBytes{0x90, 0x41, 0xFF},
          test::TBytes{0x90, 0x60, 0x03, 0xFF}, test::TBytes{0x88, 0x30, 0x02, 0xFF}}) {
        const test::CTemporaryFolder folder;
        CBabbler babbler(text);
        const test::CEmulator emulator(babbler, (folder / "port").string());
        EXPECT_THROW(CViscaCamera((folder / "port").string(), options), CViscaError);
    }
}

TEST_F(ViscaFaults, ALostCompletionIsMadeUpForByLooking) {
    CViscaCamera camera(port(), quick());
    misbehave({EFault::noCompletion});
    camera.moveTo(DEG2RAD(4.0), 0);
    EXPECT_NO_THROW(camera.wait());
    EXPECT_NEAR(truePan(), 35, 1e-9);
}

TEST_F(ViscaFaults, AHeadThatStopsShortIsReported) {
    CViscaCamera camera(port(), quick());
    misbehave({EFault::jam});
    camera.moveTo(DEG2RAD(20.0), 0);
    EXPECT_THROW(camera.wait(), CViscaError);
    EXPECT_NO_THROW(camera.wait());  // it is over
}

TEST_F(ViscaFaults, SilenceIsReportedAndACameraThatReturnsIsAddressedAgain) {
    auto options = quick();
    options.retries = 1;
    CViscaCamera camera(port(), options);
    m_emulator.locked([&] { m_device.sleep(true); });
    EXPECT_EQ(codeOf([&] { camera.panTilt(); }), 0);
    EXPECT_EQ(codeOf([&] { camera.moveTo(0, 0); }), 0);
    m_emulator.locked([&] { m_device.sleep(false); });
    EXPECT_NO_THROW(camera.panTilt());
}

TEST_F(ViscaFaults, ACameraThatWasSwitchedOffAndOnIsAddressedAgain) {
    CViscaCamera camera(port(), quick());
    m_emulator.locked([&] { m_device.restart(); });
    EXPECT_NO_THROW(camera.panTilt());
    m_emulator.locked([&] { m_device.restart(); });
    camera.moveTo(DEG2RAD(2.0), 0);
    camera.wait();
    EXPECT_NEAR(truePan(), 18, 1e-9);
}

TEST_F(ViscaFaults, ACameraThatIsNotInTheChainIsNamed) {
    auto options = quick();
    options.address = 2;
    try {
        CViscaCamera camera(port(), options);
        ADD_FAILURE() << "camera 2 of 1";
    } catch (const CViscaError& error) {
        EXPECT_EQ(std::string(error.what()), port() + ": there is no camera 2 in a chain of 1");
    }
}

TEST_F(ViscaFaults, AtTheWrongRateNobodyAnswers) {
    auto options = quick();
    options.baud = 19200;
    options.retries = 0;
    EXPECT_EQ(codeOf([&] { CViscaCamera camera(port(), options); }), 0);
}

TEST_F(ViscaFaults, APulledCableIsAnErrorAndANewDriverGoesOn) {
    {
        CViscaCamera camera(port(), quick());
        camera.moveTo(DEG2RAD(50.0), 0, DEG2RAD(10.0));
        m_emulator.unplug();
        EXPECT_THROW(camera.wait(), CPortError);
        EXPECT_THROW(camera.panTilt(), CPortError);
        EXPECT_THROW(CViscaCamera(port(), quick()), CPortError);
    }
    m_emulator.plug();
    CViscaCamera camera(port(), quick());
    EXPECT_NO_THROW(camera.panTilt());
}

TEST_F(ViscaFaults, AnyMixtureOfFaultsLeavesADriverThatWorks) {
    std::mt19937 random(20042);
    CViscaCamera camera(port(), quick());
    for (int run = 0; run < 12; ++run) {
        std::deque<EFault> faults;
        for (int i = 0; i < 6; ++i) faults.push_back(static_cast<EFault>(random() % 11));
        misbehave(faults);
        try {
            camera.moveTo(DEG2RAD(static_cast<double>(random() % 11) - 5), 0);
            camera.wait();
        } catch (const CViscaError&) {
            // refused or given up: that is an answer
        }
    }
    misbehave({});
    camera.moveTo(DEG2RAD(5.0), DEG2RAD(-5.0));
    camera.wait();
    EXPECT_NEAR(truePan(), 44, 1e-9);
    EXPECT_NEAR(trueTilt(), -60, 1e-9);
}
