#pragma once
// One thread at a time: what works with the interpreter released could be asked for by another thread meanwhile.

#include <stdexcept>
#include <string>

namespace zlg::python {

class Use {
public:
    // is_busy  of the object, read and written with the interpreter held.
    //
    // errors  RuntimeError: another thread uses it.
    Use(bool& is_busy, const char* what) : is_busy_{is_busy} {
        if (is_busy) throw std::runtime_error{std::string{"this "} + what + " is in use by another thread"};
        is_busy = true;
    }
    ~Use() { is_busy_ = false; }
    Use(const Use&) = delete;
    Use& operator=(const Use&) = delete;

private:
    bool& is_busy_;
};

}  // namespace zlg::python
