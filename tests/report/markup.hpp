#pragma once
// A small reader of well-formed XML, enough to judge the figures and the body of the page.

#include "test.hpp"

namespace markup {

struct Element {
    std::string name;
    std::map<std::string, std::string> attributes;
    std::string text;                // of this element alone
    std::vector<std::size_t> above;  // ancestors, outermost first
};

// Reads all elements in the order of their opening tags. Throws std::runtime_error at the first fault.
class Reader {
public:
    explicit Reader(std::string source) : source_{std::move(source)} {}

    std::vector<Element> read() {
        while (at_ < source_.size()) {
            if (source_[at_] == '<') {
                tag();
            } else {
                const std::string piece = until("<", true);
                if (!open_.empty()) elements_[open_.back()].text += unescaped(piece);
            }
        }
        if (!open_.empty()) throw std::runtime_error("not closed: " + elements_[open_.back()].name);
        return elements_;
    }

private:
    void tag() {
        ++at_;
        const bool closing = source_.at(at_) == '/';
        if (closing) ++at_;
        const std::string tag_name = name();
        if (closing) {
            if (open_.empty() || elements_[open_.back()].name != tag_name)
                throw std::runtime_error("stray </" + tag_name);
            open_.pop_back();
            expect('>');
            return;
        }
        Element element{tag_name, {}, {}, open_};
        while (std::isspace(static_cast<unsigned char>(source_.at(at_))) != 0) {
            ++at_;
            if (std::isalpha(static_cast<unsigned char>(source_.at(at_))) != 0) attribute(element);
        }
        elements_.push_back(element);
        const bool empty = source_.at(at_) == '/';
        if (empty) ++at_;
        expect('>');
        if (!empty) open_.push_back(elements_.size() - 1);
    }

    void attribute(Element& element) {
        const std::string key = name();
        expect('=');
        expect('"');
        const std::string value = until("\"", false);
        expect('"');
        if (value.find('<') != std::string::npos) throw std::runtime_error("< in attribute " + key);
        if (!element.attributes.emplace(key, unescaped(value)).second) throw std::runtime_error("twice: " + key);
    }

    std::string name() {
        const std::size_t from = at_;
        while (std::isalnum(static_cast<unsigned char>(source_.at(at_))) != 0 || source_[at_] == '-') ++at_;
        if (at_ == from) throw std::runtime_error("a name is missing at " + std::to_string(at_));
        return source_.substr(from, at_ - from);
    }

    std::string until(const std::string& mark, bool or_end) {
        const std::size_t end = source_.find(mark, at_);
        if (end == std::string::npos && !or_end) throw std::runtime_error("not ended: " + source_.substr(at_, 20));
        const std::string out = source_.substr(at_, end - at_);
        at_ = end == std::string::npos ? source_.size() : end;
        return out;
    }

    void expect(char c) {
        if (source_.at(at_) != c)
            throw std::runtime_error(std::string{c} + " expected, got " + source_.substr(at_, 20));
        ++at_;
    }

    static std::string unescaped(const std::string& text) {
        static const std::map<std::string, std::string> entities{
            {"amp", "&"}, {"lt", "<"}, {"gt", ">"}, {"quot", "\""}, {"#39", "'"}};
        std::string out;
        for (std::size_t i = 0; i < text.size(); ++i) {
            if (text[i] == '>') throw std::runtime_error("bare > in " + text);
            if (text[i] != '&') {
                out += text[i];
                continue;
            }
            const std::size_t end = text.find(';', i);
            if (end == std::string::npos) throw std::runtime_error("bare & in " + text);
            out += entities.at(text.substr(i + 1, end - i - 1));
            i = end;
        }
        return out;
    }

    std::string source_;
    std::size_t at_ = 0;
    std::vector<std::size_t> open_;
    std::vector<Element> elements_;
};

inline std::vector<Element> read(const std::string& source) { return Reader{source}.read(); }

inline double number(const Element& element, const std::string& key) { return std::stod(element.attributes.at(key)); }

// Elements called `name`; with `within`, only those under an element of that class.
inline std::vector<Element> all(const std::vector<Element>& elements, const std::string& name,
                                const std::string& within = "") {
    std::vector<Element> out;
    for (const Element& e : elements) {
        bool inside = within.empty();
        for (const std::size_t i : e.above) {
            const auto found = elements[i].attributes.find("class");
            inside = inside || (found != elements[i].attributes.end() && found->second == within);
        }
        if (inside && e.name == name) out.push_back(e);
    }
    return out;
}

inline Element of_class(const std::vector<Element>& elements, const std::string& name) {
    for (const Element& e : elements) {
        const auto found = e.attributes.find("class");
        if (found != e.attributes.end() && found->second == name) return e;
    }
    throw std::runtime_error("no element of class " + name);
}

}  // namespace markup
