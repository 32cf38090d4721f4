#pragma once
// What a message is after its way over a good line.

#include <zlg/wire/frame.hpp>

#include "test.hpp"

namespace zlg::wire {

template <class T> std::vector<std::uint8_t> body_of(const T& message) {
    Sender sender;
    const Frame frame = frame_of(sender, message);
    Receiver receiver;
    std::span<const std::uint8_t> left = frame.view();
    Message received;
    EXPECT_TRUE(receive(receiver, left, received));
    return {received.body.begin(), received.body.end()};
}

}  // namespace zlg::wire
