// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>

namespace salma::config {

/// `text` with round brackets for square ones: the catch blocks of MRPT's programs take a message
/// apart at those, which would turn it round.
inline std::string withoutBrackets(std::string text) {
    std::replace(text.begin(), text.end(), '[', '(');
    std::replace(text.begin(), text.end(), ']', ')');
    return text;
}

}  // namespace salma::config
