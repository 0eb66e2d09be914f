// SPDX-License-Identifier: BSD-3-Clause
// Puts a CFakeVideo under a program, below libv4l2: libv4l2 and libv4lconvert make their system
// calls through syscall(), which this library, loaded before the system's by LD_PRELOAD, answers
// for the file /dev/fake-video. SALMA_FAKE_VIDEO in the environment sets the card up.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/syscall.h>

#include <cerrno>
#include <cstdarg>
#include <cstdlib>
#include <cstring>
#include <memory>

#include "CFakeVideo.h"

namespace {

constexpr auto kFile = "/dev/fake-video";

std::unique_ptr<salma::test::CFakeVideo>& card() {
    static std::unique_ptr<salma::test::CFakeVideo> instance;
    return instance;
}

int& descriptor() {
    static int value = -1;
    return value;
}

long plugIn() {
    const char* const setup = std::getenv("SALMA_FAKE_VIDEO");
    card() = std::make_unique<salma::test::CFakeVideo>(setup != nullptr ? setup : "");
    return descriptor() = card()->open();
}

long answer(int error) {
    if (error == 0) return 0;
    errno = error;
    return -1;
}

bool isCard(long fd) { return descriptor() >= 0 && fd == descriptor(); }

}  // namespace

extern "C" long syscall(long number, ...) noexcept {
    using TCall = long (*)(long, long, long, long, long, long, long);
    static const auto real = reinterpret_cast<TCall>(dlsym(RTLD_NEXT, "syscall"));
    va_list list;
    va_start(list, number);
    long a[6];
    for (long& argument : a) argument = va_arg(list, long);
    va_end(list);
    const auto isFile = [](long text) {
        return std::strcmp(reinterpret_cast<const char*>(text), kFile) == 0;
    };
    if (number == SYS_openat && isFile(a[1])) return plugIn();
#ifdef SYS_open
    if (number == SYS_open && isFile(a[0])) return plugIn();
#endif
    if (number == SYS_ioctl && isCard(static_cast<int>(a[0])))
        return answer(
            card()->ioctl(static_cast<unsigned long>(a[1]), reinterpret_cast<void*>(a[2])));
    if (number == SYS_mmap && isCard(static_cast<int>(a[4]))) {
        void* const memory = card()->map(a[5]);
        if (memory != nullptr) return reinterpret_cast<long>(memory);
        errno = EINVAL;
        return reinterpret_cast<long>(MAP_FAILED);
    }
    return real(number, a[0], a[1], a[2], a[3], a[4], a[5]);
}
