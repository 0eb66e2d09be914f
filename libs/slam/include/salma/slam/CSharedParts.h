// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <iterator>
#include <memory>
#include <mutex>
#include <unordered_map>

namespace salma::slam {

/** Number of this process, drawn when it starts. */
std::uint64_t processNumber();

/** Constant objects of one type that several maps of this process hold in common, each under a
 * number of its own.
 *
 * MRPT copies a map by writing it into memory and reading it back; what is written then is the
 * number. The objects belong to the maps: one that no map holds any more is forgotten. Safe to use
 * from several threads. */
template <class T>
class CSharedParts {
 public:
    static CSharedParts& instance() {
        static CSharedParts parts;
        return parts;
    }

    /// \param object Not null. \return Its number, never 0; a new one if it had none.
    std::uint64_t numberOf(const std::shared_ptr<const T>& object) {
        const std::lock_guard<std::mutex> lock(m_mutex);
        const auto known = m_numbers.find(object.get());
        if (known != m_numbers.end() && !m_objects.at(known->second).expired())
            return known->second;
        forgetExpired();
        m_numbers[object.get()] = ++m_last;
        m_objects[m_last] = object;
        return m_last;
    }

    /// 0 if the object has none.
    std::uint64_t numberOf(const T& object) const {
        const std::lock_guard<std::mutex> lock(m_mutex);
        const auto known = m_numbers.find(&object);
        const bool alive = known != m_numbers.end() && !m_objects.at(known->second).expired();
        return alive ? known->second : 0;
    }

    /// Null if no map holds an object of that number.
    std::shared_ptr<const T> find(std::uint64_t number) const {
        const std::lock_guard<std::mutex> lock(m_mutex);
        const auto known = m_objects.find(number);
        return known == m_objects.end() ? nullptr : known->second.lock();
    }

 private:
    /// An address may be used again by another object, so both tables lose those that are gone.
    void forgetExpired() {
        if (m_objects.size() < m_nextCleaning) return;
        for (auto i = m_objects.begin(); i != m_objects.end();)
            i = i->second.expired() ? m_objects.erase(i) : std::next(i);
        for (auto i = m_numbers.begin(); i != m_numbers.end();)
            i = m_objects.count(i->second) == 0 ? m_numbers.erase(i) : std::next(i);
        m_nextCleaning = 2 * m_objects.size() + 64;
    }

    mutable std::mutex m_mutex;
    std::unordered_map<const T*, std::uint64_t> m_numbers;
    std::unordered_map<std::uint64_t, std::weak_ptr<const T>> m_objects;
    std::uint64_t m_last{0};
    std::size_t m_nextCleaning{64};
};

}  // namespace salma::slam
