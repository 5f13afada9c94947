// studies NAME [FOLDER]: a study for developers, with the table and picture of `ashlar study`.
#include <iostream>

#include "apps/program/study/study_command.hpp"
#include "benchmarks/studies/studies.hpp"

int main(int count, char** arguments) {
  if (count < 2 || count > 3) {
    std::cerr << "studies NAME [FOLDER]\n";
    for (const ashlar::Study& study : ashlar::developer_studies())
      std::cerr << "  " << study.name << ": " << study.description << '\n';
    return ashlar::exit_status::bad_input;
  }
  ashlar::StudyOptions options{arguments[1], {}};
  if (count == 3) options.folder = arguments[2];
  return ashlar::study_command(options, ashlar::developer_studies(), std::cout, std::cerr);
}
