/// Writes and reads the end mark of a child's answer, and the kind of answer behind it.

#include "geometry/base/isolated_answer.hpp"

#include <new>
#include <sstream>
#include <string_view>

#include "geometry/base/error.hpp"

namespace quadrille {

namespace {

/// The kind of a child's answer, which it writes at the very end. A child that crashes does not get there.
enum Answer : char {
  result = 'R',
  failure_sentence = 'F',
  usage_sentence = 'U',
  no_memory = answer_without_memory.back()
};
constexpr std::string_view end_of_answer = answer_without_memory.substr(0, answer_without_memory.size() - 1);

std::string sentence_about(const std::string& subject, const std::exception& problem) {
  return subject + ": " + sentence_of(problem);
}

Answer answer(const std::string& subject, const std::function<void(std::ostream&)>& work, std::ostream& out) {
  try {
    work(out);
    return result;
  } catch (const Error& error) {
    out << error.what();
    return error.kind() == Error::Kind::usage ? usage_sentence : failure_sentence;
  } catch (const std::exception& problem) {
    out << sentence_about(subject, problem);
  }
  return failure_sentence;
}

}  // namespace

void write_answer(const std::string& subject, const std::function<void(std::ostream&)>& work,
                  std::ostream& out) {
  const Answer given = answer(subject, work, out);
  out << end_of_answer << static_cast<char>(given);
  out.flush();
}

std::string result_of(const IsolatedWork& options, std::string bytes) {
  const std::size_t length = end_of_answer.size() + 1;
  const std::string_view all = bytes;
  if (all.size() < length || !all.substr(all.size() - length).starts_with(end_of_answer))
    throw failure(options.subject, options.crashed);
  const char given = bytes.back();
  if (given == no_memory) throw failure(options.subject, sentence_about(options.subject, std::bad_alloc()));
  bytes.resize(bytes.size() - length);
  if (given == failure_sentence) throw failure(options.subject, bytes);
  if (given == usage_sentence) throw usage_error(options.subject, bytes);
  return bytes;
}

void run_isolated(const IsolatedWork& options, const std::function<void(std::ostream&)>& work,
                  const std::function<void(std::istream&)>& take) {
  std::istringstream in(run_in_child(options, work));
  take(in);
}

std::string isolated_bytes(const IsolatedWork& options, const std::function<std::string()>& make) {
  return run_in_child(options, [&](std::ostream& out) { out << make(); });
}

}  // namespace quadrille
