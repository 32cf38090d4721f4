#pragma once
// How a text file writes its table: what parts the columns and what the fraction.

#include <cstdint>
#include <string>
#include <vector>

#include "csv/text_fields.hpp"

namespace zlg::logs {

struct Line {
    std::int64_t number = 0;
    std::string text;
    std::string comment;  // the last one above it, without its mark; of the first lines alone
};

// What stands at the head of a file, comments and lines to skip left out.
struct FirstLines {
    std::vector<Line> lines;
    std::vector<std::string> head;   // the first comments, without their mark
    bool has_other_letters = false;  // not UTF-8, and more in a row than Latin-1 has of other letters than ASCII's
    bool is_whole = false;           // the file has no more lines
    bool is_terminated = true;       // its last line has an end
};

struct Dialect {
    char separator = blanks_separator;
    Mark mark = Mark::none;     // none: no line of the sample shows it
    bool mark_is_sure = false;  // said, or shown by a number whose mark can part no thousands
    std::size_t n_fields = 0;
    bool ends_empty = false;          // each row has nothing behind its last separator
    bool has_header = false;          // the first line of the sample
    std::vector<std::string> names;   // of the columns; empty where they have none
    std::vector<std::size_t> wanted;  // fields that are asked for, from 0
};

}  // namespace zlg::logs
