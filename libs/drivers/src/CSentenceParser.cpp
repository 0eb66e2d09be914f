// SPDX-License-Identifier: BSD-3-Clause
#include <salma/drivers/CSentenceParser.h>

#include <charconv>
#include <cmath>

namespace salma::drivers {
namespace {

/// Nothing but a number, and a finite one.
bool readNumber(const char* begin, const char* end, double& value) {
    const auto [stop, error] = std::from_chars(begin, end, value);
    return error == std::errc() && stop == end && std::isfinite(value);
}

bool checksumIsRight(const std::string& text, std::size_t star) {
    unsigned found = 0, sum = 0;
    const char* const end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + star + 1, end, found, 16);
    for (std::size_t i = 1; i < star; ++i) sum ^= static_cast<std::uint8_t>(text[i]);
    return error == std::errc() && stop == end && text.size() == star + 3 && found == sum;
}

}  // namespace

std::vector<TSentence> CSentenceParser::push(const std::uint8_t* bytes,
                                             std::size_t size,
                                             double time,
                                             double byteTime) {
    std::vector<TSentence> sentences;
    for (std::size_t i = 0; i < size; ++i) {
        const char c = static_cast<char>(bytes[i]);
        if (c == '$') {
            if (!m_text.empty()) ++m_counts.badSentences;  // the one before broke off
            m_text = "$";
            m_began = time - byteTime * static_cast<double>(size - 1 - i);
        } else if (m_text.empty()) {
            continue;
        } else if (c == '\r' || c == '\n') {
            TSentence sentence;
            const bool good = finish(sentence);
            ++(good ? m_counts.sentences : m_counts.badSentences);
            if (good) sentences.push_back(std::move(sentence));
            m_text.clear();
        } else if (m_text.size() + 2 == maxSentence) {
            ++m_counts.badSentences;
            m_text.clear();
        } else {
            m_text += c;
        }
    }
    return sentences;
}

bool CSentenceParser::finish(TSentence& sentence) {
    const std::size_t star = m_text.rfind('*');
    if (star == std::string::npos || !checksumIsRight(m_text, star)) return false;
    sentence.began = m_began;
    std::size_t begin = m_text.find_first_of(",*");
    sentence.name = m_text.substr(1, begin - 1);
    while (m_text[begin] == ',') {
        const std::size_t end = m_text.find_first_of(",*", begin + 1);
        double value = 0;
        if (!readNumber(m_text.data() + begin + 1, m_text.data() + end, value)) return false;
        sentence.values.push_back(value);
        begin = end;
    }
    return begin == star && !sentence.name.empty();
}

}  // namespace salma::drivers
