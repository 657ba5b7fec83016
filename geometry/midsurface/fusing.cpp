/// Gives OpenCASCADE a progress indicator that checks the context for cancellation.

#include "geometry/midsurface/fusing.hpp"

#include <Message_ProgressIndicator.hxx>
#include <exception>

namespace quadrille {

namespace {

class AskContext : public Message_ProgressIndicator {
 public:
  explicit AskContext(const ExecutionContext& context) : context_(context) {}

  /// After the first break OpenCASCADE asks again in each of its nested loops: the answer stays the same.
  Standard_Boolean UserBreak() override {
    if (ended_) return Standard_True;
    try {
      context_.check();
    } catch (...) {  // no other exception may pass through OpenCASCADE; thrown again by throw_end()
      ended_ = std::current_exception();
    }
    return ended_ ? Standard_True : Standard_False;
  }

  void throw_end() const {
    if (ended_) std::rethrow_exception(ended_);
    context_.check();
  }

 private:
  void Show(const Message_ProgressScope&, const Standard_Boolean) override {}

  const ExecutionContext& context_;
  std::exception_ptr ended_;
};

}  // namespace

void under_limit(const ExecutionContext& context,
                 const std::function<void(const Message_ProgressRange&)>& work) {
  const Handle(AskContext) progress = new AskContext(context);
  work(progress->Start());
  progress->throw_end();
}

void perform(BOPAlgo_Builder& fuse, const ExecutionContext& context) {
  fuse.SetNonDestructive(Standard_True);
  fuse.SetUseOBB(Standard_True);
  under_limit(context, [&](const Message_ProgressRange& range) { fuse.Perform(range); });
}

TopTools_ListOfShape images(const BOPAlgo_Builder& fuse, const TopoDS_Shape& face) {
  if (fuse.Images().IsBound(face)) return fuse.Images().Find(face);
  TopTools_ListOfShape itself;
  itself.Append(face);
  return itself;
}

TopTools_ListOfShape images(BRepBuilderAPI_MakeShape& made, const TopoDS_Shape& part) {
  TopTools_ListOfShape result = made.Modified(part);
  if (result.IsEmpty()) result.Append(part);
  return result;
}

}  // namespace quadrille
