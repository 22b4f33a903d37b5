#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <vtkCellArray.h>
#include <vtkCompositePolyDataMapper2.h>
#include <vtkDataSetMapper.h>
#include <vtkGlyph3DMapper.h>
#include <vtkImageData.h>
#include <vtkMatrix4x4.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkOpenGLSphereMapper.h>
#include <vtkPlane.h>
#include <vtkPointData.h>
#include <vtkProperty.h>
#include <vtkShaderProperty.h>
#include <vtkTextActor.h>
#include <vtkTexture.h>
#include <vtkUnsignedCharArray.h>

#include <functional>
#include <string>
#include <vector>

#include "tests/vtk/drawing.h"

/// What is not opaque triangles alone is named, and the rest is judged as if it were not there.
namespace fathom::vtk {
namespace {

void cut_in_two(vtkActor& actor) {
  vtkNew<vtkPlane> plane;
  plane->SetNormal(1, 0, 0);
  actor.GetMapper()->AddClippingPlane(plane);
}

void add_line(vtkActor& actor) {
  auto* const data = vtkPolyData::SafeDownCast(actor.GetMapper()->GetInputAsDataSet());
  vtkNew<vtkCellArray> lines;
  lines->InsertNextCell({0, 40});
  data->SetLines(lines);
}

void add_vertex(vtkActor& actor) {
  auto* const data = vtkPolyData::SafeDownCast(actor.GetMapper()->GetInputAsDataSet());
  vtkNew<vtkCellArray> vertices;
  vertices->InsertNextCell({7});
  data->SetVerts(vertices);
}

void hide_a_cell(vtkActor& actor) {
  vtkDataSet* const data = actor.GetMapper()->GetInputAsDataSet();
  data->AllocateCellGhostArray()->SetValue(3, vtkDataSetAttributes::HIDDENCELL);
}

void draw_by_composite(vtkActor& actor) {
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, actor.GetMapper()->GetInputAsDataSet());
  vtkNew<vtkCompositePolyDataMapper2> mapper;
  mapper->SetInputDataObject(blocks);
  actor.SetMapper(mapper);
}

void draw_as_glyphs(vtkActor& actor) {
  vtkNew<vtkGlyph3DMapper> mapper;
  mapper->SetInputData(actor.GetMapper()->GetInputAsDataSet());
  mapper->SetSourceData(ball(4));
  mapper->SetScaleFactor(0.1);
  actor.SetMapper(mapper);
}

void draw_by_data_set_mapper(vtkActor& actor) {
  vtkNew<vtkDataSetMapper> mapper;
  mapper->SetInputData(actor.GetMapper()->GetInputAsDataSet());
  actor.SetMapper(mapper);
}

void draw_as_spheres(vtkActor& actor) {
  vtkNew<vtkOpenGLSphereMapper> mapper;
  mapper->SetInputData(vtkPolyData::SafeDownCast(actor.GetMapper()->GetInputAsDataSet()));
  actor.SetMapper(mapper);
}

void project(vtkActor& actor) {
  vtkNew<vtkMatrix4x4> matrix;
  matrix->SetElement(3, 2, 0.1);
  actor.SetUserMatrix(matrix);
}

struct Case {
  std::string why;
  std::function<void(vtkActor&)> set;
};

const std::vector<Case> cases{
    {"is translucent", [](vtkActor& a) { a.GetProperty()->SetOpacity(0.4); }},
    {"has clipping planes", cut_in_two},
    {"is drawn as points or lines",
     [](vtkActor& a) { a.GetProperty()->SetRepresentationToPoints(); }},
    {"is drawn as points or lines",
     [](vtkActor& a) { a.GetProperty()->SetRepresentationToWireframe(); }},
    {"has visible edges", [](vtkActor& a) { a.GetProperty()->EdgeVisibilityOn(); }},
    {"has visible vertices", [](vtkActor& a) { a.GetProperty()->VertexVisibilityOn(); }},
    {"culls faces", [](vtkActor& a) { a.GetProperty()->FrontfaceCullingOn(); }},
    {"culls faces", [](vtkActor& a) { a.GetProperty()->BackfaceCullingOn(); }},
    {"has custom shader code",
     [](vtkActor& a) {
       a.GetShaderProperty()->AddFragmentShaderReplacement("//VTK::Depth::Impl", true,
                                                           "gl_FragDepth = 0.1;\n", false);
     }},
    {"has lines", add_line},
    {"has vertices", add_vertex},
    {"has hidden or ghost cells", hide_a_cell},
    {"is drawn by a vtkCompositePolyDataMapper2, not a vtkPolyDataMapper", draw_by_composite},
    {"is drawn by a vtkOpenGLGlyph3DMapper, not a vtkPolyDataMapper", draw_as_glyphs},
    {"is drawn by a vtkOpenGLSphereMapper, not a vtkPolyDataMapper", draw_as_spheres},
    {"is drawn by a vtkDataSetMapper, not a vtkPolyDataMapper", draw_by_data_set_mapper},
    {"has a matrix that is not affine", project},
    {"has no mapper", [](vtkActor& a) { a.SetMapper(nullptr); }},
};

TEST(LeftOut, IsNamedAndTheRestIsJudged) {
  for (const Case& c : cases) {
    SCOPED_TRACE(c.why);
    Drawing drawing;
    drawing.add(ball()).SetPosition(-0.5, 0, 0);
    vtkActor& other = drawing.add(ball());  // in front of the first, were it drawn
    other.SetPosition(0, 0, 0.5);
    c.set(other);
    const DepthVerdict verdict = drawing.explained();
    EXPECT_TRUE(verdict.is_good()) << verdict;
    ASSERT_EQ(verdict.left_out.size(), 1U);
    EXPECT_EQ(verdict.left_out[0].prop, "vtkOpenGLActor 1");
    EXPECT_EQ(verdict.left_out[0].why, c.why);
    EXPECT_EQ(verdict.truth.mesh.triangles.size(), 2 * 12U * 24U);
    EXPECT_TRUE(other.GetVisibility());  // shown again
  }
}

TEST(LeftOut, IsWhatCoincidentTopologyMoves) {
  Drawing drawing;
  drawing.add(ball());
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  EXPECT_THROW(drawing.explained(), std::exception);
  vtkMapper::SetResolveCoincidentTopologyToOff();
  EXPECT_TRUE(drawing.explained().is_good());
}

TEST(LeftOut, IsAnAnnotation) {
  Drawing drawing;
  drawing.add(ball());
  vtkNew<vtkTextActor> text;
  text->SetInput("a title");
  drawing.renderer().AddViewProp(text);
  const DepthVerdict verdict = drawing.explained();
  EXPECT_TRUE(verdict.is_good()) << verdict;
  ASSERT_EQ(verdict.left_out.size(), 1U);
  EXPECT_EQ(verdict.left_out[0].why, "is no actor");
}

TEST(LeftOut, IsNothingThatIsInvisible) {
  Drawing drawing;
  drawing.add(ball());
  drawing.add(ball()).VisibilityOff();
  const DepthVerdict verdict = drawing.explained();
  EXPECT_TRUE(verdict.is_good()) << verdict;
  EXPECT_TRUE(verdict.left_out.empty());
  EXPECT_EQ(verdict.truth.mesh.triangles.size(), 2 * 12U * 24U);
}

// A texture colours what it covers and moves no depth.
TEST(LeftOut, IsNoOpaqueTexture) {
  Drawing drawing;
  vtkSmartPointer<vtkPolyData> data = ball();
  vtkNew<vtkUnsignedCharArray> colours;
  vtkNew<vtkImageData> image;
  image->SetDimensions(2, 2, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  vtkNew<vtkTexture> texture;
  texture->SetInputData(image);
  drawing.add(data).SetTexture(texture);
  const DepthVerdict verdict = drawing.explained();
  EXPECT_TRUE(verdict.is_good()) << verdict;
  EXPECT_TRUE(verdict.left_out.empty()) << verdict;
}

}  // namespace
}  // namespace fathom::vtk
