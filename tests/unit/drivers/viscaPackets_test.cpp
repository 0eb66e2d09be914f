// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <salma/drivers/viscaPackets.h>

using namespace salma::drivers::visca;

// Expected bytes are written down from Sony's command list.

TEST(ViscaPackets, AreAsInTheCommandList) {
    EXPECT_EQ(addressSet(), (TPacket{0x88, 0x30, 0x01, 0xFF}));
    EXPECT_EQ(interfaceClear(1), (TPacket{0x81, 0x01, 0x00, 0x01, 0xFF}));
    EXPECT_EQ(panTiltInquiry(1), (TPacket{0x81, 0x09, 0x06, 0x12, 0xFF}));
    EXPECT_EQ(zoomInquiry(3), (TPacket{0x83, 0x09, 0x04, 0x47, 0xFF}));
    EXPECT_EQ(panTiltHome(7), (TPacket{0x87, 0x01, 0x06, 0x04, 0xFF}));
    EXPECT_EQ(cancel(1, 2), (TPacket{0x81, 0x22, 0xFF}));
    EXPECT_EQ(zoomDirect(1, 0x3FF),
              (TPacket{0x81, 0x01, 0x04, 0x47, 0x00, 0x03, 0x0F, 0x0F, 0xFF}));
}

TEST(ViscaPackets, CarryPositionsInFourBitsAByteWithSign) {
    EXPECT_EQ(panTiltAbsolute(1, {0x18, 0x14}, {0x35D, -0x11D}),
              (TPacket{0x81, 0x01, 0x06, 0x02, 0x18, 0x14, 0x00, 0x03, 0x05, 0x0D, 0x0F, 0x0E, 0x0E,
                       0x03, 0xFF}));
    EXPECT_EQ(panTiltRelative(2, {1, 1}, {-1, 0}),
              (TPacket{0x82, 0x01, 0x06, 0x03, 0x01, 0x01, 0x0F, 0x0F, 0x0F, 0x0F, 0x00, 0x00, 0x00,
                       0x00, 0xFF}));
}

TEST(ViscaPackets, RefuseWhatDoesNotFitAField) {
    EXPECT_THROW(interfaceClear(0), std::invalid_argument);
    EXPECT_THROW(zoomInquiry(8), std::invalid_argument);
    EXPECT_THROW(zoomDirect(1, -1), std::invalid_argument);
    EXPECT_THROW(panTiltAbsolute(1, {0x19, 1}, {}), std::invalid_argument);
    EXPECT_THROW(panTiltAbsolute(1, {1, 0x15}, {}), std::invalid_argument);
    EXPECT_THROW(panTiltAbsolute(1, {0, 1}, {}), std::invalid_argument);
    EXPECT_THROW(panTiltAbsolute(1, {1, 1}, {0x8000, 0}), std::invalid_argument);
    EXPECT_THROW(cancel(1, 0), std::invalid_argument);
}

TEST(ViscaPackets, AnswersAreReadBack) {
    const auto head = decodePanTilt({0x0F, 0x0C, 0x0A, 0x04, 0x00, 0x01, 0x01, 0x0E});
    ASSERT_TRUE(head);
    EXPECT_EQ(head->pan, -860);
    EXPECT_EQ(head->tilt, 286);
    EXPECT_EQ(decodeZoom({0, 3, 0x0F, 0x0F}), 1023);
}

TEST(ViscaPackets, WhatIsNoAnswerIsNotRead) {
    EXPECT_FALSE(decodePanTilt({0, 0, 0, 0}));
    EXPECT_FALSE(decodePanTilt({0, 0, 0, 0, 0, 0, 0, 0x10}));
    EXPECT_FALSE(decodePanTilt({}));
    EXPECT_FALSE(decodeZoom({0, 0, 0}));
    EXPECT_FALSE(decodeZoom({0, 0x7F, 0, 0}));
}
