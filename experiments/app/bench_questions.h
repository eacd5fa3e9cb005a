// What only the bench knows, asked on a terminal: each answer is checked at once, and none is lost.
#pragma once

#include <string>

#include "experiments/campaign/spec/spec_draft.h"

namespace CLI {
class App;
}

namespace talus::app {

// The flags that answer a question each.
void AddQuestionFlags(CLI::App& verb, campaign::SpecAnswers& answers);

bool AsksOnTerminal();

// A line of input behind the words; empty where there is none, or the usual answer is taken.
std::string AskLine(const std::string& words);

// Asks on a terminal for what is not given; elsewhere every missing flag is named at once.
void Complete(campaign::SpecAnswers& answers);

// All questions once more, of which Enter keeps the answer. False where there is no more input.
bool AskAgain(campaign::SpecAnswers& answers);

// What is wrong with a spec of these answers, which is no file yet: without the lines of `out`, and
// with the flag in place of the key that it is the answer of.
std::string ProblemsByFlag(const std::string& problems, const campaign::SpecAnswers& answers,
                           const std::string& out);

// The answers as the flags that would give them again: " --mass '1.5 g' …".
std::string AnswerFlags(const campaign::SpecAnswers& answers);

}  // namespace talus::app
