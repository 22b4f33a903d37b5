#include "fathom/vtk/explain_depth.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkAssembly.h>
#include <vtkCellArray.h>
#include <vtkMatrix4x4.h>
#include <vtkPoints.h>
#include <vtkProperty.h>
#include <vtkTransform.h>

#include <cmath>
#include <sstream>
#include <string>
#include <utility>

#include "fathom/failures/errors.h"
#include "tests/inputs/floating_point_modes.h"
#include "tests/vtk/drawing.h"

/// What VTK draws by itself is explained, whatever its camera and actors.
namespace fathom::vtk {
namespace {

using ::testing::HasSubstr;

/// Every pixel is explained, and no bound is so wide that it would explain anything.
void expect_explained(const DepthVerdict& verdict, std::size_t least_pixels = 1000) {
  EXPECT_TRUE(verdict.is_good()) << verdict;
  EXPECT_TRUE(verdict.left_out.empty()) << verdict;
  EXPECT_GE(covered_pixels(verdict), least_pixels);
  EXPECT_LT(verdict.attribution.sharpness.median_relative_width, 2e-5);
  EXPECT_LT(verdict.attribution.sharpness.may_share, 0.25);
}

TEST(ExplainDepth, OfOneActor) {
  Drawing drawing;
  drawing.add(ball());
  const DepthVerdict verdict = drawing.explained();
  expect_explained(verdict);
  // The centre of the ball's face is 4 from the eye.
  EXPECT_NEAR(verdict.truth.depths[60 * 160 + 80], 4, 0.05);
  EXPECT_NEAR(verdict.map.depths[60 * 160 + 80], verdict.truth.depths[60 * 160 + 80], 1e-5);
}

TEST(ExplainDepth, IsTheSameInEveryFloatingPointMode) {
  Drawing drawing;
  drawing.add(ball());
  checks::expect_same_in_all_modes([&] {
    const DepthVerdict verdict = drawing.explained();
    return std::pair(verdict.map.depths, verdict.attribution.counts);
  });
}

TEST(ExplainDepth, OfActorsThatAreMovedTurnedAndScaled) {
  Drawing drawing;
  drawing.add(ball());
  for (int i = 0; i < 5; ++i) {
    vtkActor& actor =
        drawing.add(ball(8 + i, i % 2 == 0 ? Coordinates::binary32 : Coordinates::binary64));
    actor.SetPosition(0.4 * i - 0.7, 0.3 * i - 0.5, 0.9);
    actor.SetScale(0.3, 0.7 - 0.1 * i, 0.45);
    actor.RotateX(17 * i);
    actor.RotateY(71 - 5 * i);
  }
  vtkNew<vtkMatrix4x4> sheared;
  sheared->SetElement(0, 1, 0.3);
  sheared->SetElement(2, 0, -0.2);
  sheared->SetElement(1, 3, 0.6);
  drawing.add(ball(9)).SetUserMatrix(sheared);
  expect_explained(drawing.explained(), 4000);
}

// VTK shifts what lies far from the origin, and the model knows it.
TEST(ExplainDepth, FarFromTheOrigin) {
  Drawing drawing;
  vtkSmartPointer<vtkPolyData> far = ball(16);
  for (vtkIdType i = 0; i < far->GetNumberOfPoints(); ++i) {
    double p[3];
    far->GetPoint(i, p);
    far->GetPoints()->SetPoint(i, p[0] + 431234.125, p[1] + 5412345.5, p[2] + 321.7);
  }
  drawing.add(far);
  drawing.camera().SetPosition(431234.5, 5412345.7, 326.2);
  drawing.camera().SetFocalPoint(431234.1, 5412345.5, 321.7);
  drawing.camera().SetClippingRange(1, 20);
  const DepthVerdict verdict = drawing.explained();
  expect_explained(verdict);
  const auto& raster = std::get<attribution::RasterModel>(verdict.model.kind);
  EXPECT_NEAR(raster.parts.at(0).shift[1], 5412345.5, 1);
}

TEST(ExplainDepth, OfPolygonsAndStrips) {
  Drawing drawing;
  vtkNew<vtkPoints> points;
  for (int i = 0; i < 10; ++i) {
    points->InsertNextPoint(0.31 * i - 1.4, i % 2 == 0 ? -0.9 : 0.8, 0.2 * std::cos(i));
  }
  vtkNew<vtkCellArray> polygons, strips;
  polygons->InsertNextCell({0, 2, 4, 9, 7, 3, 1});  // not plane: a fan, or else depths are off
  strips->InsertNextCell({9, 8, 7, 6, 5, 4, 3});
  vtkNew<vtkPolyData> data;
  data->SetPoints(points);
  data->SetPolys(polygons);
  data->SetStrips(strips);
  drawing.add(data);
  const DepthVerdict verdict = drawing.explained();
  expect_explained(verdict);
  EXPECT_EQ(verdict.truth.mesh.triangles.size(), 5U + 5U);
}

TEST(ExplainDepth, OfAnAssembly) {
  Drawing drawing;
  vtkActor& first = drawing.add(ball());
  vtkActor& second = drawing.add(ball());
  second.SetPosition(1.5, 0, 0);
  vtkNew<vtkAssembly> inner, outer;
  inner->AddPart(&second);
  inner->RotateZ(30);
  outer->AddPart(inner);
  outer->AddPart(&first);
  outer->SetScale(0.6);
  outer->SetPosition(-0.3, 0.1, 0.2);
  drawing.renderer().RemoveActor(&first);
  drawing.renderer().RemoveActor(&second);
  drawing.renderer().AddActor(outer);
  const DepthVerdict verdict = drawing.explained();
  expect_explained(verdict);
  EXPECT_EQ(verdict.truth.mesh.points.size(), 2 * 13U * 24U);
}

TEST(ExplainDepth, OfEveryCamera) {
  const std::vector<std::pair<std::string, void (*)(vtkCamera&)>> cameras{
      {"from the side", [](vtkCamera& c) { c.SetPosition(3, 2.5, -2.7); }},
      {"rolled", [](vtkCamera& c) { c.Roll(33); }},
      {"view up nearly along the sight", [](vtkCamera& c) { c.SetViewUp(0.001, 0, 1); }},
      {"wide", [](vtkCamera& c) { c.SetViewAngle(75); }},
      {"horizontal angle", [](vtkCamera& c) { c.UseHorizontalViewAngleOn(); }},
      {"parallel",
       [](vtkCamera& c) {
         c.ParallelProjectionOn();
         c.SetParallelScale(1.37);
       }},
      {"window centre", [](vtkCamera& c) { c.SetWindowCenter(0.25, -0.3); }},
      {"parallel window centre",
       [](vtkCamera& c) {
         c.ParallelProjectionOn();
         c.SetParallelScale(1.37);
         c.SetWindowCenter(0.25, -0.3);
       }},
      {"model transform",
       [](vtkCamera& c) {
         c.SetModelTransformMatrix(
             std::array<double, 16>{1, 0.2, 0, 0.1, 0, 0.9, -0.1, 0, 0.1, 0, 1.1, 0, 0, 0, 0, 1}
                 .data());
       }},
      {"through the ball", [](vtkCamera& c) { c.SetClippingRange(4.3, 4.9); }},
  };
  for (const auto& [name, set] : cameras) {
    SCOPED_TRACE(name);
    Drawing drawing;
    drawing.add(ball());
    set(drawing.camera());
    expect_explained(drawing.explained(), 700);
  }
}

// As Render() would place it.
TEST(ExplainDepth, OfACameraThatNobodyMade) {
  const validation::EglContext context;
  vtkNew<validation::SurfacelessWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkPolyDataMapper> mapper;
  mapper->SetInputData(ball());
  vtkNew<vtkActor> actor;
  actor->SetMapper(mapper);
  renderer->AddActor(actor);
  window->SetSize(160, 120);
  window->AddRenderer(renderer);
  const DepthVerdict verdict = explain_depth(*window, *renderer);
  expect_explained(verdict);
  EXPECT_LT(covered_pixels(verdict), 160U * 120U / 2);
  window->Finalize();
}

TEST(ExplainDepth, OfAPartOfTheWindow) {
  Drawing drawing;
  drawing.add(ball());
  drawing.renderer().SetViewport(0.25, 0.1, 0.9, 0.8);
  const DepthVerdict verdict = drawing.explained();
  expect_explained(verdict);
  EXPECT_EQ(verdict.map.width, 104U);
  EXPECT_EQ(verdict.map.height, 84U);
}

TEST(ExplainDepth, OfSeveralSamplesThatOfTheFirst) {
  Drawing drawing;
  drawing.add(ball());
  drawing.window().SetMultiSamples(4);
  const DepthVerdict verdict = drawing.explained();
  EXPECT_TRUE(verdict.is_good()) << verdict;
  EXPECT_NE(verdict.model.sample.x, 0.5);
}

TEST(ExplainDepth, TextIsALineForEachThing) {
  Drawing drawing;
  drawing.add(ball());
  drawing.add(ball()).GetProperty()->SetOpacity(0.5);
  std::ostringstream text;
  text << drawing.explained();
  EXPECT_THAT(text.str(), ::testing::StartsWith("every pixel is explained\n"));
  EXPECT_THAT(text.str(), HasSubstr(" equal\n"));
  EXPECT_THAT(text.str(), HasSubstr("left out: vtkOpenGLActor 1 is translucent\n"));
}

void expect_refusal(Drawing& drawing, const std::string& why) {
  try {
    drawing.explained();
    ADD_FAILURE() << "expected: " << why;
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), HasSubstr(why));
  }
}

TEST(ExplainDepth, SaysWhyThereIsNoVerdict) {
  Drawing drawing;
  expect_refusal(drawing, "the renderer shows no opaque triangles");
  vtkActor& actor = drawing.add(ball());
  actor.GetProperty()->SetRepresentationToWireframe();
  expect_refusal(drawing, "no opaque triangles: vtkOpenGLActor 0 is drawn as points or lines");
  actor.GetProperty()->SetRepresentationToSurface();
  drawing.window().SetNumberOfLayers(2);
  expect_refusal(drawing, "the window has 2 layers");
  drawing.window().SetNumberOfLayers(1);
  drawing.camera().SetViewShear(0.2, -0.1, 1);
  expect_refusal(drawing, "camera: projection: expected a perspective projection without");
  drawing.camera().SetViewShear(0, 0, 1);
  vtkNew<vtkRenderer> elsewhere;
  EXPECT_THROW(explain_depth(drawing.window(), *elsewhere), InputError);
  expect_explained(drawing.explained());
}

}  // namespace
}  // namespace fathom::vtk
