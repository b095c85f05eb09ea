#include "earthtop/model/ledger.hpp"

namespace earthtop {

std::string_view to_string(LedgerObserver observer) {
  switch (observer) {
    case LedgerObserver::inertial: return "inertial";
    case LedgerObserver::laboratory: return "laboratory";
    case LedgerObserver::platform: return "platform";
    case LedgerObserver::body: return "body";
  }
  return "unknown";
}

}  // namespace earthtop
