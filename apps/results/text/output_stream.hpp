// Stream buffer that passes text to an OutputFile at once: std::ostream stream(&buffer). On failure the stream has
// badbit.
#pragma once

#include <streambuf>
#include <string_view>
#include <utility>

#include "apps/results/system/output_file.hpp"

namespace ashlar {

class OutputStreamBuffer final : public std::streambuf {
 public:
  explicit OutputStreamBuffer(OutputFile file) : file_(std::move(file)) {}

 private:
  std::streamsize xsputn(const char* text, std::streamsize size) override {
    file_.write(std::string_view(text, static_cast<std::size_t>(size)));
    return size;
  }
  int_type overflow(int_type letter) override {
    if (traits_type::eq_int_type(letter, traits_type::eof())) return traits_type::not_eof(letter);
    const char one = traits_type::to_char_type(letter);
    file_.write(std::string_view(&one, 1));
    return letter;
  }

  OutputFile file_;
};

}  // namespace ashlar
