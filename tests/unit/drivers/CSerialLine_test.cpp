// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <messages.h>
#include <salma/drivers/CSerialLine.h>

#include "CPseudoTerminal.h"
#include "CTemporaryFolder.h"

using namespace salma;
using drivers::CPortError;
using drivers::CSerialLine;
using test::TBytes;

namespace {

using salma::test::contains;

class SerialLine : public testing::Test {
 protected:
    std::string link() const { return (m_folder / "port").string(); }

    static std::string openingError(const std::string& port) {
        try {
            CSerialLine line(port, 9600);
        } catch (const CPortError& error) {
            return error.what();
        }
        return "";
    }

    test::CTemporaryFolder m_folder;
};

}  // namespace

TEST_F(SerialLine, CarriesEveryByteUnchangedBothWays) {
    test::CPseudoTerminal device(link());
    CSerialLine line(link(), 9600);
    EXPECT_EQ(device.baud(), 9600);
    TBytes all;  // what a terminal would take for line ends, interrupts, flow control as well
    for (int byte = 0; byte < 256; ++byte) all.push_back(static_cast<std::uint8_t>(byte));
    line.write(all);
    TBytes got;
    while (got.size() < all.size()) {
        const TBytes piece = device.read(5000);
        ASSERT_FALSE(piece.empty());
        got.insert(got.end(), piece.begin(), piece.end());
    }
    EXPECT_EQ(got, all);
    device.write(all);
    got.clear();
    while (got.size() < all.size()) {
        const TBytes piece = line.read(5);
        ASSERT_FALSE(piece.empty());
        got.insert(got.end(), piece.begin(), piece.end());
    }
    EXPECT_EQ(got, all);
    EXPECT_TRUE(line.read(0).empty());
}

TEST_F(SerialLine, APortThatDoesNotExistIsNamed) {
    EXPECT_TRUE(contains(openingError("/no/such/port"), "/no/such/port: no such serial port"));
    EXPECT_TRUE(contains(openingError("no-such-port"), "/dev/no-such-port: no such serial port"));
    EXPECT_TRUE(contains(openingError(""), "/dev/: "));
}

TEST_F(SerialLine, WhatIsNoPortIsRefused) {
    EXPECT_TRUE(contains(openingError("/dev/null"), "is not a serial port"));
    EXPECT_TRUE(contains(openingError(m_folder.write("file", "x")), "is not a serial port"));
    EXPECT_TRUE(contains(openingError(m_folder.path().string()), m_folder.path().string()));
}

TEST_F(SerialLine, ABusyPortIsRefusedUntilItIsFree) {
    test::CPseudoTerminal device(link());
    {
        CSerialLine first(link(), 9600);
        EXPECT_TRUE(contains(openingError(link()), "is in use by another program"));
        first.write({1});  // the refused one has not disturbed it
        EXPECT_EQ(device.read(5000), TBytes{1});
    }
    EXPECT_EQ(openingError(link()), "");
}

TEST_F(SerialLine, APortThatGoesAwayIsAnErrorForBothWays) {
    test::CPseudoTerminal device(link());
    CSerialLine line(link(), 9600);
    device.unplug();
    EXPECT_THROW(line.read(5), CPortError);
    EXPECT_THROW(line.write({1}), CPortError);
    EXPECT_TRUE(contains(openingError(link()), "no such serial port"));
    device.plug();
    CSerialLine again(link(), 9600);
    again.write({2});
    EXPECT_EQ(device.read(5000), TBytes{2});
}

TEST_F(SerialLine, AnOtherSideThatTakesNothingEndsTheWrite) {
    test::CPseudoTerminal device(link());
    CSerialLine line(link(), 9600);
    EXPECT_THROW(line.write(TBytes(1 << 20, 0x55)), CPortError);
}
