// Recursive descent, one function per level of precedence:
//
//   comparison = sum [("<" | "<=" | ">" | ">=" | "==" | "!=") sum]
//   sum        = product {("+" | "-") product}
//   product    = factor {("*" | "/") factor}
//   factor     = ("+" | "-") factor | power
//   power      = primary ["^" factor]
//   primary    = number ["deg" | "rad"] | name | name "(" comparison {"," comparison} ")" | "(" comparison ")"
//
// Each function appends the instructions of what it has read, so that the program is in postfix order.
#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>

#include "expr/expression.hpp"

namespace chainreel {
namespace {

constexpr std::size_t kMaxText = 10000;
constexpr std::array<std::string_view, 13> kUnits = {"m", "mm", "cm", "km", "s", "ms", "us", "min", "h", "kg", "N", "J", "Hz"};  // of scenes

// Functions that are written by others: the angle of a place, quotients, comparisons. Their operation is the last one.
enum class Written { itself, arc_sine, arc_cosine, arc_tangent, hyperbolic_tangent, sign };

struct Function {
  std::string_view name;
  Operation operation;
  Name told;
  int arguments = 1;
  bool or_more = false;
  Written written = Written::itself;
};

constexpr std::array kFunctions = {
    Function{"sin", Operation::sine, {"sin(x)", "sine"}},
    Function{"cos", Operation::cosine, {"cos(x)", "cosine"}},
    Function{"tan", Operation::tangent, {"tan(x)", "tangent"}},
    Function{"sqrt", Operation::square_root, {"sqrt(x)", "square root"}},
    Function{"exp", Operation::exponential, {"exp(x)", "e to the power of x"}},
    Function{"log", Operation::logarithm, {"log(x)", "natural logarithm"}},
    Function{"abs", Operation::absolute, {"abs(x)", "without its sign"}},
    Function{"asin", Operation::arc_tangent2, {"asin(x)", "the angle with this sine: atan2(x, sqrt((1 - x)*(1 + x)))"}, 1, false, Written::arc_sine},
    Function{"acos", Operation::arc_tangent2, {"acos(x)", "the angle with this cosine: atan2(sqrt((1 - x)*(1 + x)), x)"}, 1, false, Written::arc_cosine},
    Function{"atan", Operation::arc_tangent2, {"atan(x)", "the angle with this tangent: atan2(x, 1)"}, 1, false, Written::arc_tangent},
    Function{"atan2", Operation::arc_tangent2, {"atan2(y, x)", "the angle of the place (x, y)"}, 2},
    Function{"tanh", Operation::subtract, {"tanh(x)", "from -1 to 1, smooth in between: friction is `-5 * tanh(qd1 / 0.01)`"}, 1, false, Written::hyperbolic_tangent},
    Function{"sign", Operation::add, {"sign(x)", "-1, 0 or 1: (x > 0) - (x < 0)"}, 1, false, Written::sign},
    Function{"min", Operation::minimum, {"min(a, b, ..)", "the least"}, 2, true},
    Function{"max", Operation::maximum, {"max(a, b, ..)", "the largest"}, 2, true},
};

const Function* find_function(std::string_view name) {
  const auto found =
      std::find_if(kFunctions.begin(), kFunctions.end(), [&](const Function& f) { return f.name == name; });
  return found == kFunctions.end() ? nullptr : &*found;
}

// Independent of the locale, unlike std::isalpha and its kin.
bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool starts_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

// A piece of the text as a message shows it.
std::string quoted(std::string_view piece) {
  constexpr std::size_t kLongest = 40;
  if (piece.size() > kLongest) return "'" + std::string(piece.substr(0, kLongest)) + "..'";
  return "'" + std::string(piece) + "'";
}

class Parser {
 public:
  Parser(std::string_view text, std::span<const std::string> names, const Place& place)
      : text_(text), names_(names), place_(place) {}

  Program parse() {
    if (text_.size() > kMaxText)
      fail(0, "an expression may have " + std::to_string(kMaxText) + " characters, this one has " +
                  std::to_string(text_.size()));
    if (next() == '\0' && at_end()) fail(0, "empty expression: a number or a formula is wanted");
    parse_comparison();
    if (!at_end()) fail_after_expression();
    return std::move(program_);
  }

 private:
  [[noreturn]] void fail(std::size_t offset, const std::string& message) const {
    Place place = place_;
    if (place.column > 0) place.column += int(offset);
    throw Error(ExitCode::bad_input, message, place);
  }

  bool at_end() const { return offset_ >= text_.size(); }

  // The next character that is no space, or 0.
  char next() {
    while (!at_end() && is_space(text_[offset_])) ++offset_;
    return at_end() ? '\0' : text_[offset_];
  }

  bool take(std::string_view symbol) {
    next();
    if (!text_.substr(offset_).starts_with(symbol)) return false;
    offset_ += symbol.size();
    return true;
  }

  void emit(Operation operation, std::int32_t slot = 0, double number = 0) {
    program_.instructions.push_back({operation, slot, number});
    depth_of_stack_ += stack_change_of(operation);
    program_.stack_size = std::max(program_.stack_size, depth_of_stack_);
    if (program_.stack_size > kMaxStack || program_.instructions.size() > kMaxInstructions)
      fail(offset_, "the expression is too long");
  }

  // Counts the levels of recursion that text can ask for.
  struct Level {
    explicit Level(Parser& parser) : nesting(parser.nesting_) {
      if (++nesting > kMaxNesting + 1)  // the expression itself is at level one
        parser.fail(parser.offset_, "nested deeper than " + std::to_string(kMaxNesting) + " levels");
    }
    ~Level() { --nesting; }
    Level(const Level&) = delete;
    Level& operator=(const Level&) = delete;
    int& nesting;
  };

  void parse_comparison() {
    parse_sum();
    const std::optional<Operation> comparison = take_comparison();
    if (!comparison) return;
    parse_sum();
    emit(*comparison);
    next();
    const std::size_t second = offset_;
    if (take_comparison()) fail(second, "comparisons do not chain: write (a < b) * (b < c)");
  }

  std::optional<Operation> take_comparison() {
    if (take("<=")) return Operation::less_equal;
    if (take(">=")) return Operation::greater_equal;
    if (take("==")) return Operation::equal;
    if (take("!=")) return Operation::not_equal;
    if (take("<")) return Operation::less;
    if (take(">")) return Operation::greater;
    return std::nullopt;
  }

  void parse_sum() {
    parse_product();
    for (char c = next(); c == '+' || c == '-'; c = next()) {
      ++offset_;
      parse_product();
      emit(c == '+' ? Operation::add : Operation::subtract);
    }
  }

  void parse_product() {
    parse_factor();
    for (char c = next(); c == '*' || c == '/'; c = next()) {
      ++offset_;
      if (c == '*' && next() == '*') fail(offset_ - 1, "a power is written with ^");
      parse_factor();
      emit(c == '*' ? Operation::multiply : Operation::divide);
    }
  }

  void parse_factor() {
    const Level level(*this);
    const char sign = next();
    if (sign != '+' && sign != '-') return parse_power();
    ++offset_;
    parse_factor();
    if (sign == '-') emit(Operation::negate);
  }

  void parse_power() {
    parse_primary();
    if (!take("^")) return;
    parse_factor();
    emit(Operation::power);
  }

  void parse_primary() {
    const char c = next();
    const std::size_t begin = offset_;
    if (is_digit(c) || c == '.') return parse_number();
    if (starts_name(c)) return parse_name();
    if (take("(")) {
      parse_comparison();
      return close(begin);
    }
    if (at_end()) fail(text_.size(), "the expression ends where a value is wanted");
    fail_at_symbol("a value is wanted");
  }

  void close(std::size_t opening) {
    if (take(")")) return;
    if (at_end()) fail(opening, "this '(' is never closed");
    fail_after_expression();
  }

  void parse_number() {
    const std::size_t begin = offset_;
    const auto skip = [&](auto accepted) {
      while (!at_end() && accepted(text_[offset_])) ++offset_;
    };
    skip([](char c) { return is_digit(c) || c == '.'; });
    if (exponent_follows()) {
      offset_ += 2;
      skip(is_digit);
    }
    const std::string_view digits = text_.substr(begin, offset_ - begin);
    double value = 0;
    const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (code == std::errc::result_out_of_range)
      fail(begin, quoted(digits) + " is outside the range of numbers");
    if (code != std::errc() || end != digits.data() + digits.size()) {
      skip([](char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; });  // YAML's .nan and .inf
      fail(begin, quoted(text_.substr(begin, offset_ - begin)) + " is not a number");
    }
    if (take_unit("deg") || take_unit("\u00b0")) return emit_degrees(value);
    take_unit("rad");
    emit(Operation::number, 0, value);
    if (!at_end() && starts_name(text_[offset_])) fail_at_unit();
  }

  // "e5", "e+5" or "e-5"; a bare e begins a name.
  bool exponent_follows() const {
    const std::string_view rest = text_.substr(offset_);
    if (rest.size() < 2 || (rest[0] != 'e' && rest[0] != 'E')) return false;
    if (is_digit(rest[1])) return true;
    return (rest[1] == '+' || rest[1] == '-') && rest.size() > 2 && is_digit(rest[2]);
  }

  std::string_view take_name() {
    const std::size_t begin = offset_;
    while (!at_end() && (starts_name(text_[offset_]) || is_digit(text_[offset_]))) ++offset_;
    return text_.substr(begin, offset_ - begin);
  }

  // Right behind the digits, as in 45deg.
  bool take_unit(std::string_view unit) {
    const std::string_view behind = text_.substr(offset_);
    if (!behind.starts_with(unit)) return false;
    if (behind.size() > unit.size() && (starts_name(behind[unit.size()]) || is_digit(behind[unit.size()]))) return false;
    offset_ += unit.size();
    return true;
  }

  // pi / 180 first: the same bits as an angle of a scene has.
  void emit_degrees(double value) {
    emit(Operation::pi);
    emit(Operation::number, 0, 180);
    emit(Operation::divide);
    emit(Operation::number, 0, value);
    emit(Operation::multiply);
  }

  [[noreturn]] void fail_at_unit() {
    const std::size_t end = offset_;
    const std::string_view name = take_name();
    const bool is_unit = std::find(kUnits.begin(), kUnits.end(), name) != kUnits.end();
    if (is_unit && std::find(names_.begin(), names_.end(), name) == names_.end())
      fail(end, "numbers in expressions have no unit but deg or rad: they are in SI units and radians");
    fail(end, "an operator is missing before " + quoted(name));
  }

  void parse_name() {
    const std::size_t begin = offset_;
    const std::string_view name = take_name();
    const bool called = next() == '(';
    const Function* function = find_function(name);
    if (called) {
      if (function == nullptr) fail_at_unknown(begin, name, called);
      return parse_call(*function, begin);
    }
    if (function != nullptr)
      fail(begin, quoted(name) + " is a function: write " + std::string(name) + "(..)");
    if (name == "pi") return emit(Operation::pi);
    const auto found = std::find(names_.begin(), names_.end(), name);
    if (found == names_.end()) {
      fail_if_assignment();  // of tau1 = 5 the name is not what is wrong
      fail_at_unknown(begin, name, called);
    }
    emit(Operation::variable, std::int32_t(found - names_.begin()));
  }

  void parse_call(const Function& function, std::size_t begin) {
    const std::size_t opening = offset_, first = program_.instructions.size();
    take("(");
    int arguments = 0;
    if (next() != ')') {
      do {
        parse_comparison();
        ++arguments;
        if (function.or_more && arguments > 1) emit(function.operation);
      } while (take(","));
    }
    close(opening);
    const bool too_many = arguments > function.arguments && !function.or_more;
    if (too_many || arguments < function.arguments) fail_at_count(function, begin, arguments);
    if (function.written != Written::itself) emit_written(function.written, first);
    if (!function.or_more) emit(function.operation);
  }

  // All but the last operation, of the argument x that the instructions from `first` on put on the stack.
  void emit_written(Written as, std::size_t first) {
    const std::vector<Instruction> argument(program_.instructions.begin() + std::ptrdiff_t(first), program_.instructions.end());
    program_.instructions.resize(first);
    --depth_of_stack_;
    const auto x = [&] {
      for (const Instruction& one : argument) emit(one.operation, one.slot, one.number);
    };
    const auto number = [this](double value) { emit(Operation::number, 0, value); };
    // sqrt((1 - x) * (1 + x))
    const auto other_leg = [&] {
      number(1), x(), emit(Operation::subtract);
      number(1), x(), emit(Operation::add);
      emit(Operation::multiply), emit(Operation::square_root);
    };
    switch (as) {
      case Written::arc_sine: return x(), other_leg();
      case Written::arc_cosine: return other_leg(), x();
      case Written::arc_tangent: return x(), number(1);
      case Written::sign:
        x(), number(0), emit(Operation::greater);
        x(), number(0), emit(Operation::less), emit(Operation::subtract);
        return number(0), x(), emit(Operation::multiply);  // what is no number has no sign
      // 1 - 2 / (exp(min(2 x, 80)) + 1): beyond 40 it is 1 to the last digit, and exp stays within its range.
      case Written::hyperbolic_tangent:
        number(1), number(2);
        number(2), x(), emit(Operation::multiply);
        number(80), emit(Operation::minimum), emit(Operation::exponential);
        return number(1), emit(Operation::add), emit(Operation::divide);
      case Written::itself: return x();
    }
  }

  [[noreturn]] void fail_at_count(const Function& function, std::size_t begin, int arguments) const {
    std::string message = std::string(function.name) + " takes " + std::to_string(function.arguments);
    if (function.or_more) message += " or more";
    message += function.arguments == 1 ? " argument" : " arguments";
    message += ", not " + std::to_string(arguments);
    if (arguments > function.arguments) message += " (decimals are written with a point: 1.5)";
    fail(begin, message);
  }

  [[noreturn]] void fail_at_unknown(std::size_t begin, std::string_view name, bool called) const {
    const bool is_variable = name == "pi" || std::find(names_.begin(), names_.end(), name) != names_.end();
    if (called && is_variable) fail(begin, "an operator is missing between " + quoted(name) + " and '('");
    std::vector<std::string> candidates;
    if (called) {
      for (const Function& function : kFunctions) candidates.emplace_back(function.name);
    } else {
      candidates.assign(names_.begin(), names_.end());
      candidates.emplace_back("pi");
    }
    fail(begin, std::string("unknown ") + (called ? "function " : "name ") + quoted(name) +
                    hint_for(name, candidates));
  }

  static std::string hint_for(std::string_view name, const std::vector<std::string>& candidates) {
    constexpr std::size_t kLongestToCompare = 64;  // the comparison takes time with the square of the length
    const std::string hint = name.size() <= kLongestToCompare ? did_you_mean(name, candidates) : "";
    if (!hint.empty()) return ":" + hint;
    constexpr std::size_t kMostToList = 24;
    if (candidates.size() > kMostToList) return "";
    std::string list;
    for (const std::string& candidate : candidates)
      list += (list.empty() ? "; known here: " : " ") + candidate;
    return list;
  }

  void fail_if_assignment() {
    next();
    const std::string_view rest = text_.substr(offset_);
    if (rest.starts_with(":=") || (rest.starts_with("=") && !rest.starts_with("==")))
      fail(offset_, "there is one value per expression and no assignment; == compares");
  }

  // Something stands where an operator, or the end, was wanted.
  [[noreturn]] void fail_after_expression() {
    const char c = next();
    if (c == ',')
      fail(
          offset_,
          "a comma cannot stand here: decimals are written with a point (1.5), and a list entry that holds a "
          "comma must be quoted");
    fail_if_assignment();
    if (c == ')') fail(offset_, "this ')' closes nothing");
    if (is_digit(c) || c == '.' || c == '(' || starts_name(c))
      fail(offset_, "an operator is missing before this value");
    fail_at_symbol("an operator is wanted");
  }

  [[noreturn]] void fail_at_symbol(const std::string& wanted) const {
    const char c = text_[offset_];
    if (c == ',' || c == ')' || c == '=' || c == '<' || c == '>' || c == '*' || c == '/' || c == '^')
      fail(offset_, quoted(text_.substr(offset_, 1)) + " stands where " + wanted);
    if (c > ' ' && c < 0x7f)
      fail(offset_, quoted(text_.substr(offset_, 1)) + " has no meaning in an expression");
    // A character of several bytes is shown whole; a byte that no terminal shows, by its number.
    std::size_t size = 1;
    while (offset_ + size < text_.size() && size < 4 && (text_[offset_ + size] & 0xc0) == 0x80) ++size;
    const bool is_utf8 = (c & 0xc0) == 0xc0 && size > 1;
    if (is_utf8) fail(offset_, quoted(text_.substr(offset_, size)) + " has no meaning in an expression");
    fail(offset_,
         "byte " + std::to_string(static_cast<unsigned char>(c)) + " has no meaning in an expression");
  }

  std::string_view text_;
  std::span<const std::string> names_;
  const Place& place_;
  std::size_t offset_ = 0;
  int nesting_ = 0;
  int depth_of_stack_ = 0;
  Program program_;
};

}  // namespace

Expression Expression::parse(std::string_view text, std::span<const std::string> names, const Place& place) {
  Expression expression;
  expression.program_ = Parser(text, names, place).parse();
  expression.text_ = text;
  std::vector<int>& used = expression.used_variables_;
  for (const Instruction& instruction : expression.program_.instructions)
    if (instruction.operation == Operation::variable) used.push_back(instruction.slot);
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  if (used.empty()) expression.constant_ = expression.evaluate(std::span<const double>());
  return expression;
}

std::vector<Name> expression_functions() {
  std::vector<Name> list;
  for (const Function& function : kFunctions) list.push_back(function.told);
  return list;
}

bool is_reserved_name(std::string_view name) {
  return name == "pi" || find_function(name) != nullptr;
}

bool is_variable_name(std::string_view name) {
  return !name.empty() && starts_name(name[0]) &&
         std::all_of(name.begin(), name.end(), [](char c) { return starts_name(c) || is_digit(c); });
}

}  // namespace chainreel
