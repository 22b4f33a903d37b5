#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkMatrix3x3.h>
#include <vtkMatrix4x4.h>
#include <vtkObjectFactory.h>
#include <vtkOpenGLCamera.h>
#include <vtkOpenGLPolyDataMapper.h>

#if __has_include(<vtk_glad.h>)
#include <vtk_glad.h>
#else
#include <vtk_glew.h>
#endif

#include <functional>
#include <string>

#include "tests/vtk/drawing.h"

/// A VTK in which something is wrong is found out.
namespace fathom::vtk {
namespace {

using testing::StartsWith;

/// Does something else to OpenGL while it draws.
class FaultyMapper : public vtkOpenGLPolyDataMapper {
 public:
  static FaultyMapper* New();
  vtkTypeMacro(FaultyMapper, vtkOpenGLPolyDataMapper)
  std::function<void()> before, after;

 protected:
  void RenderPieceDraw(vtkRenderer* renderer, vtkActor* actor) override {
    before();
    Superclass::RenderPieceDraw(renderer, actor);
    after();
  }
};
vtkStandardNewMacro(FaultyMapper);

/// Gives mappers a matrix that is not its own.
class FaultyCamera : public vtkOpenGLCamera {
 public:
  static FaultyCamera* New();
  vtkTypeMacro(FaultyCamera, vtkOpenGLCamera)

  void GetKeyMatrices(vtkRenderer* renderer, vtkMatrix4x4*& view, vtkMatrix3x3*& normals,
                      vtkMatrix4x4*& projection, vtkMatrix4x4*& both) override {
    Superclass::GetKeyMatrices(renderer, view, normals, projection, both);
    view_->DeepCopy(view);
    projection_->DeepCopy(projection);
    vtkMatrix4x4& wrong = of_view_ ? *view_ : *projection_;
    wrong.SetElement(place_, place_, wrong.GetElement(place_, place_) + by_);
    vtkMatrix4x4::Multiply4x4(view_, projection_, both_);
    view = view_;
    projection = projection_;
    both = both_;
  }
  /// To an entry on the diagonal.
  void add(double by, bool of_view, int place) {
    by_ = by;
    of_view_ = of_view;
    place_ = place;
  }

 private:
  vtkNew<vtkMatrix4x4> view_, projection_, both_;
  bool of_view_ = false;
  int place_ = 0;
  double by_ = 0;
};
vtkStandardNewMacro(FaultyCamera);

DepthVerdict drawn_with(const std::function<void()>& before, const std::function<void()>& after) {
  Drawing drawing;
  vtkNew<FaultyMapper> mapper;
  mapper->before = before;
  mapper->after = after;
  drawing.add(ball(), mapper.Get());
  return drawing.explained();
}

TEST(FaultyVtk, HasNoneWhereNothingIsDone) {
  const DepthVerdict verdict = drawn_with([] {}, [] {});
  EXPECT_TRUE(verdict.is_good()) << verdict;
}

TEST(FaultyVtk, HasAShift) {
  const DepthVerdict verdict =
      drawn_with([] { glViewport(1, 0, 160, 120); }, [] { glViewport(0, 0, 160, 120); });
  EXPECT_THAT(verdict.cause, StartsWith("shift: "));
}

TEST(FaultyVtk, HasAPolygonOffset) {
  const DepthVerdict verdict = drawn_with(
      [] {
        glEnable(GL_POLYGON_OFFSET_FILL);
        glPolygonOffset(
            0, 640);  // five steps of binary32 on llvmpipe, an eighth of what a pixel is allowed
      },
      [] { glDisable(GL_POLYGON_OFFSET_FILL); });
  EXPECT_THAT(verdict.cause, StartsWith("bias: "));
}

TEST(FaultyVtk, HasAnotherDepthRange) {
  const DepthVerdict verdict =
      drawn_with([] { glDepthRange(0, 0.999); }, [] { glDepthRange(0, 1); });
  EXPECT_FALSE(verdict.is_good());
}

TEST(FaultyVtk, HasCulledFaces) {
  const DepthVerdict verdict = drawn_with(
      [] {
        glEnable(GL_CULL_FACE);
        glCullFace(GL_BACK);
        glFrontFace(GL_CW);
      },
      [] {
        glDisable(GL_CULL_FACE);
        glFrontFace(GL_CCW);
      });
  EXPECT_THAT(verdict.cause, StartsWith("culling: ")) << verdict;
}

TEST(FaultyVtk, HasAScissor) {
  const DepthVerdict verdict = drawn_with(
      [] {
        glEnable(GL_SCISSOR_TEST);
        glScissor(0, 0, 80, 120);
      },
      [] { glScissor(0, 0, 160, 120); });
  EXPECT_FALSE(verdict.is_good());
}

// A matrix that is 10⁻¹⁰ off would be explained to the last pixel, if it were believed.
TEST(FaultyVtk, HasAMatrixThatIsNotOfItsCamera) {
  for (const bool of_view : {false, true}) {
    for (const int place : {0, 1, 2}) {
      SCOPED_TRACE(std::to_string(place) + (of_view ? " of view" : " of projection"));
      Drawing drawing;
      vtkNew<FaultyCamera> camera;
      camera->SetPosition(0.3, 0.2, 5);
      camera->SetClippingRange(1, 20);
      drawing.renderer().SetActiveCamera(camera);
      drawing.add(ball());
      EXPECT_TRUE(drawing.explained().is_good());
      camera->add(1e-10, of_view, place);
      EXPECT_THAT(drawing.explained().cause, StartsWith("camera: its matrices do not follow"));
    }
  }
}

}  // namespace
}  // namespace fathom::vtk
