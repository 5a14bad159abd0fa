// SPDX-License-Identifier: MIT
//
// Threads as the ports begin them: with a stack of a known size, and without signals.
#pragma once

#include <pthread.h>
#include <semaphore.h>
#include <signal.h>

#include <cstddef>

namespace fovea::linux_port {

/// Of a thread of ours. What they do takes about 8 KiB; the sanitizers want more.
inline constexpr std::size_t thread_stack_bytes = 256 * 1024;

/// Begins a thread to which no signal is delivered: these are for who began it. Answers 0 or the errno.
inline int begin_thread(pthread_t& thread, void* (*work)(void*), void* about) {
    pthread_attr_t attributes;
    if (const int error = ::pthread_attr_init(&attributes); error != 0) return error;
    static_cast<void>(::pthread_attr_setstacksize(&attributes, thread_stack_bytes));
    // The thread has the signal mask of who begins it.
    sigset_t all;
    sigset_t before;
    ::sigfillset(&all);
    static_cast<void>(::pthread_sigmask(SIG_SETMASK, &all, &before));
    const int error = ::pthread_create(&thread, &attributes, work, about);
    static_cast<void>(::pthread_sigmask(SIG_SETMASK, &before, nullptr));
    static_cast<void>(::pthread_attr_destroy(&attributes));
    return error;
}

/// Waits until somebody posts, whatever signals come meanwhile.
inline void wait_for(sem_t& something) {
    while (::sem_wait(&something) != 0) continue;  // interrupted
}

}  // namespace fovea::linux_port
