// C++ exceptions in WebAssembly: the half of them that Debian's libc++abi for wasm32 is made without.
//
// The engine itself unwinds the stack. What the compiler calls (by the names of the Itanium C++ ABI, "Exception
// Handling", and of LLVM's WebAssembly back end) is here: memory for what is thrown, which handlers are entered, and
// the search of a function's table of handlers for the first one that takes the type. Within one thread, for classes
// without multiple bases and for types that are no classes; a handler for a base of another kind is not found, and the
// exception goes on.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <exception>
#include <new>
#include <typeinfo>

// The table of virtual functions of std::type_info for a class with one public base, by which such a class is known.
extern "C" const void* _ZTVN10__cxxabiv120__si_class_type_infoE[];

namespace {

// Stands before each thing that is thrown. On this machine a destructor returns the address of its object.
struct alignas(std::max_align_t) Thrown {
    const std::type_info* type = nullptr;
    void* (*destroy)(void*) = nullptr;
    int handlers = 0;          // that it is in
    bool goes_on = false;      // thrown again out of its handler, which must not destroy it
    Thrown* around = nullptr;  // in whose handler this one was caught
};

Thrown* innermost = nullptr;  // of those that are being handled

Thrown* head(void* object) { return static_cast<Thrown*>(object) - 1; }

// The layout of std::type_info for a class with one public base at its own address (Itanium C++ ABI, 2.9.5).
struct SingleBase {
    const void* virtual_functions;
    const char* name;
    const std::type_info* base;
};

bool is_a(const std::type_info* type, const std::type_info& wanted) {
    while (*type != wanted) {
        const auto* single = reinterpret_cast<const SingleBase*>(type);
        if (single->virtual_functions != &_ZTVN10__cxxabiv120__si_class_type_infoE[2]) return false;
        type = single->base;
    }
    return true;
}

// LEB128, the variable length of DWARF: seven bits a byte, the lowest first; in a signed one the last byte's bit 6 is
// the sign.
std::uintptr_t unsigned_number(const std::uint8_t*& at) {
    std::uintptr_t value = 0;
    for (unsigned shift = 0;; shift += 7) {
        const std::uint8_t byte = *at++;
        value |= static_cast<std::uintptr_t>(byte & 0x7f) << shift;
        if ((byte & 0x80) == 0) return value;
    }
}

std::intptr_t signed_number(const std::uint8_t*& at) {
    const std::uint8_t* begin = at;
    const std::uintptr_t value = unsigned_number(at);
    const auto bits = 7 * static_cast<unsigned>(at - begin);
    const bool negative = (at[-1] & 0x40) != 0 && bits < 32;
    return static_cast<std::intptr_t>(negative ? value | (~std::uintptr_t{0} << bits) : value);
}

// A function's table: two bytes of encodings, which are always the same on this machine, the way to the end of the list
// of types, one more encoding, and the length of the list of places with their first actions, after which the actions
// lie.
struct Table {
    const std::uint8_t* places;
    const std::uint8_t* actions;
    const std::type_info* const* types_end;  // type n is the n-th before it

    explicit Table(const std::uint8_t* at) {
        at += 2;
        const std::uintptr_t to_types_end = unsigned_number(at);
        types_end = reinterpret_cast<const std::type_info* const*>(at + to_types_end);
        ++at;
        const std::uintptr_t length = unsigned_number(at);
        places = at;
        actions = at + length;
    }

    // One more than the offset of the first action of this place, 0 where there is none.
    [[nodiscard]] std::uintptr_t first_action(std::uintptr_t place) const {
        for (const std::uint8_t* at = places; at < actions;) {
            const std::uintptr_t number = unsigned_number(at);
            const std::uintptr_t action = unsigned_number(at);
            if (number == place) return action;
        }
        return 0;
    }

    // The number of the first handler at this place that takes the type; 0 where none does.
    [[nodiscard]] std::uintptr_t handler(std::uintptr_t place, const std::type_info* type) const {
        const std::uintptr_t first = first_action(place);
        if (first == 0) return 0;
        for (const std::uint8_t* at = actions + first - 1;;) {
            const std::intptr_t number = signed_number(at);
            const std::uint8_t* here = at;
            const std::intptr_t to_next = signed_number(at);
            const std::type_info* wanted = number > 0 ? *(types_end - number) : nullptr;
            // No type: catch (...).
            if (number > 0 && (wanted == nullptr || is_a(type, *wanted))) return static_cast<std::uintptr_t>(number);
            if (to_next == 0) return 0;
            at = here + to_next;
        }
    }
};

constexpr int cpp_tag = 0;  // the kind of WebAssembly exceptions that are those of C++

}  // namespace

extern "C" {

// Filled by the compiled code before a search, but for the last, which is the answer.
struct LandingPad {
    std::uintptr_t place;
    const std::uint8_t* table;
    std::uintptr_t handler;
} __wasm_lpad_context;

int _Unwind_CallPersonality(void* object) {
    __wasm_lpad_context.handler =
        Table{__wasm_lpad_context.table}.handler(__wasm_lpad_context.place, head(object)->type);
    return 0;
}

void* __cxa_allocate_exception(std::size_t bytes) noexcept {
    void* memory = std::malloc(sizeof(Thrown) + bytes);
    if (memory == nullptr) std::terminate();
    return new (memory) Thrown{} + 1;
}

void __cxa_free_exception(void* object) noexcept { std::free(head(object)); }

[[noreturn]] void __cxa_throw(void* object, const std::type_info* type, void* (*destroy)(void*)) {
    head(object)->type = type;
    head(object)->destroy = destroy;
    __builtin_wasm_throw(cpp_tag, object);
}

void* __cxa_get_exception_ptr(void* object) noexcept { return object; }

void* __cxa_begin_catch(void* object) noexcept {
    Thrown* thrown = head(object);
    thrown->goes_on = false;
    if (thrown->handlers++ == 0) {
        thrown->around = innermost;
        innermost = thrown;
    }
    return object;
}

void __cxa_end_catch() {
    Thrown* thrown = innermost;
    if (--thrown->handlers > 0) return;
    innermost = thrown->around;
    if (thrown->goes_on) return;
    if (thrown->destroy != nullptr) thrown->destroy(thrown + 1);
    std::free(thrown);
}

[[noreturn]] void __cxa_rethrow() {
    if (innermost == nullptr) std::terminate();
    innermost->goes_on = true;
    __builtin_wasm_throw(cpp_tag, innermost + 1);
}

}  // extern "C"
