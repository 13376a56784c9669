#pragma once

#include <stdexcept>
#include <string>

namespace isoglass {

/// A failure that the user can act on: what is wrong, where, and how to mend it.
///
/// `what()` reads "WHAT (WHERE); HINT", with the parts that are empty left out. Thrown by every room
/// for bad input and failed input/output; never used for a broken precondition of our own code.
class Error : public std::runtime_error {
  public:
    /// `where` names the place: a file, a file with a JSON pointer, a variable, a key frame.
    Error(const std::string& what, const std::string& where, const std::string& hint = {});

    const std::string& problem() const { return problem_; }  ///< what is wrong, alone
    const std::string& where() const { return where_; }
    const std::string& hint() const { return hint_; }

  private:
    std::string problem_;
    std::string where_;
    std::string hint_;
};

}  // namespace isoglass
