#include <zlg/wire/command_handler.hpp>

namespace zlg::wire {
namespace {

struct Verdict {
    RefusingPart part = RefusingPart::none;
    std::uint8_t fault = 0;
};

Verdict judged(const GyroSettings& settings) noexcept {
    const core::GyroControlFault control = check(settings.control);
    if (control != core::GyroControlFault::none) return {RefusingPart::control, static_cast<std::uint8_t>(control)};
    const core::GyroCompensationFault compensation = check(settings.compensation);
    if (compensation == core::GyroCompensationFault::none) return {};
    return {RefusingPart::compensation, static_cast<std::uint8_t>(compensation)};
}

Parameters present(const GyroSettings& settings, const Parameters& asked) noexcept {
    Parameters values = asked;
    for (std::size_t k = 0; k < values.n; ++k) values.items[k].value = parameter(settings, values.items[k].key);
    return values;
}

// In the reverse order, so that of a key that is given twice the first value comes back.
void put_back(GyroSettings& settings, const Parameters& before, std::size_t n) noexcept {
    for (std::size_t k = n; k-- > 0;) (void)put_parameter(settings, before.items[k].key, before.items[k].value);
}

// Put all of them; where one is refused, none.
bool put_all(GyroSettings& settings, const Parameters& wanted, const Parameters& before, Reply& reply) noexcept {
    for (std::size_t k = 0; k < wanted.n; ++k) {
        const Parameter& item = wanted.items[k];
        reply.result = put_parameter(settings, item.key, item.value);
        if (reply.result == CommandResult::done) continue;
        reply.key = item.key;
        put_back(settings, before, k);
        return false;
    }
    return true;
}

// The first key without which the others would be allowed; 0: there is none.
std::uint16_t culprit(GyroSettings& settings, const Parameters& wanted, const Parameters& before) noexcept {
    for (std::size_t left_out = 0; left_out < wanted.n; ++left_out) {
        for (std::size_t k = 0; k < wanted.n; ++k)
            if (wanted.items[k].key != wanted.items[left_out].key)
                (void)put_parameter(settings, wanted.items[k].key, wanted.items[k].value);
        const bool good = judged(settings).part == RefusingPart::none;
        put_back(settings, before, wanted.n);
        if (good) return wanted.items[left_out].key;
    }
    return 0;
}

void set(GyroSettings& settings, const Parameters& wanted, Reply& reply, CommandEffect& effect) noexcept {
    const Parameters before = present(settings, wanted);
    reply.parameters = before;
    if (!put_all(settings, wanted, before, reply)) return;
    const Verdict verdict = judged(settings);
    if (verdict.part == RefusingPart::none) {
        effect.settings_changed = wanted.n > 0;
        reply.parameters = present(settings, wanted);
        return;
    }
    put_back(settings, before, wanted.n);
    reply.result = CommandResult::not_allowed;
    reply.part = verdict.part;
    reply.fault = verdict.fault;
    reply.key = culprit(settings, wanted, before);
}

void read(const GyroSettings& settings, const Parameters& asked, Reply& reply) noexcept {
    reply.parameters = present(settings, asked);
    for (std::size_t k = 0; k < asked.n; ++k) {
        const double value = reply.parameters.items[k].value;
        if (value == value) continue;
        reply.result = CommandResult::unknown_key;
        reply.key = asked.items[k].key;
        return;
    }
}

void obey(CommandState& state, const Command& command, Reply& reply, CommandEffect& effect) noexcept {
    switch (command.code) {
        case CommandCode::read_state:
            effect.send_status = true;
            break;
        case CommandCode::stop_switching:
            effect.stop_switching = true;
            break;
        case CommandCode::start_switching:
            effect.start_switching = true;
            break;
        case CommandCode::force_switch:
            effect.force_switch = true;
            break;
        case CommandCode::read_parameters:
            read(state.settings, command.parameters, reply);
            break;
        case CommandCode::set_parameters:
            set(state.settings, command.parameters, reply, effect);
            break;
        case CommandCode::load:  // is no command with parameters
            break;
    }
}

bool is_repeated(const CommandState& state, const Message& message) noexcept {
    return state.has_last && state.last.session == message.session && state.last.sequence == message.sequence;
}

}  // namespace

CommandOutput handle(CommandState& state, const Message& message) noexcept {
    if (message.type != MessageType::command) return {};
    if (is_repeated(state, message)) {
        // The state may be asked for again: telling it does nothing.
        const bool asked = state.last.code == static_cast<std::uint8_t>(CommandCode::read_state);
        return {.has_reply = true, .reply = state.last, .effect = {.send_status = asked}};
    }
    CommandOutput out{.has_reply = true};
    out.reply.session = message.session;
    out.reply.sequence = message.sequence;
    out.reply.code = message.body.empty() ? std::uint8_t{0} : message.body.front();
    if (const auto command = command_in(message)) {
        obey(state, *command, out.reply, out.effect);
    } else if (piece_in(message)) {
        out.effect.load = true;
    } else {
        out.reply.result = CommandResult::malformed;
    }
    state.last = out.reply;
    state.has_last = true;
    return out;
}

}  // namespace zlg::wire
