/// Hands OpenCASCADE a progress indicator that asks the context whether to go on.

#include "geometry/midsurface/fusing.hpp"

#include <Message_ProgressIndicator.hxx>
#include <Message_ProgressRange.hxx>

#include "geometry/base/error.hpp"

namespace quadrille {

namespace {

class AskContext : public Message_ProgressIndicator {
 public:
  explicit AskContext(const ExecutionContext& context) : context_(context) {}

  Standard_Boolean UserBreak() override {
    try {
      context_.check();
    } catch (const Error&) {  // thrown again by perform(), outside of OpenCASCADE
      return Standard_True;
    }
    return Standard_False;
  }

 private:
  void Show(const Message_ProgressScope&, const Standard_Boolean) override {}

  const ExecutionContext& context_;
};

}  // namespace

void perform(BOPAlgo_Builder& fuse, const ExecutionContext& context) {
  const Handle(AskContext) progress = new AskContext(context);
  fuse.Perform(progress->Start());
  context.check();
}

}  // namespace quadrille
