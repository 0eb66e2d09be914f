// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <string>

namespace salma::drivers {

/// MRPT's catch blocks take a text apart at brackets, which would turn the message round.
inline std::string withoutBrackets(std::string text) {
    std::replace(text.begin(), text.end(), '[', '(');
    std::replace(text.begin(), text.end(), ']', ')');
    return text;
}

}  // namespace salma::drivers
