#include "vtk_scene.h"

#include <vtkActor.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkFloatArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>

namespace isoglass {
namespace {

vtkNew<vtkPolyData> polyData(const SurfaceMesh& mesh) {
    vtkNew<vtkPoints> points;
    vtkNew<vtkFloatArray> normals;
    normals->SetNumberOfComponents(3);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3 position = mesh.origin + glm::dvec3(mesh.positions[i]);
        points->InsertNextPoint(position.x, position.y, position.z);
        const glm::vec3 normal = glm::normalize(mesh.normals[i]);
        normals->InsertNextTuple3(normal.x, normal.y, normal.z);
    }
    vtkNew<vtkCellArray> triangles;
    for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
        triangles->InsertNextCell({mesh.triangles[t], mesh.triangles[t + 1], mesh.triangles[t + 2]});
    }
    vtkNew<vtkPolyData> data;
    data->SetPoints(points);
    data->SetPolys(triangles);
    data->GetPointData()->SetNormals(normals);
    return data;
}

}  // namespace

struct VtkScene::Parts {
    vtkNew<vtkRenderWindow> window;
    vtkNew<vtkRenderer> renderer;
};

VtkScene::VtkScene(const std::vector<PeerSurface>& surfaces, int side, VtkWay way)
    : parts_(std::make_unique<Parts>()) {
    for (const PeerSurface& surface : surfaces) {
        vtkNew<vtkPolyDataMapper> mapper;
        mapper->SetInputData(polyData(surface.mesh));
        mapper->ScalarVisibilityOff();
        vtkNew<vtkActor> actor;
        actor->SetMapper(mapper);
        actor->GetProperty()->SetColor(surface.color.r, surface.color.g, surface.color.b);
        actor->GetProperty()->SetOpacity(surface.opacity);
        parts_->renderer->AddActor(actor);
    }
    if (way.peels > 0) {
        parts_->renderer->SetUseDepthPeeling(1);
        parts_->renderer->SetMaximumNumberOfPeels(way.peels);
        parts_->renderer->SetOcclusionRatio(0);
    }
    parts_->window->SetOffScreenRendering(1);
    parts_->window->SetMultiSamples(0);
    parts_->window->SetSize(side, side);
    parts_->window->AddRenderer(parts_->renderer);
}

VtkScene::~VtkScene() = default;

void VtkScene::draw(double azimuthDegrees) {
    vtkCamera* camera = parts_->renderer->GetActiveCamera();
    camera->SetPosition(3, 2, 2.5);
    camera->SetFocalPoint(0, 0, 0);
    camera->SetViewUp(0, 1, 0);
    camera->SetViewAngle(30);
    camera->Azimuth(azimuthDegrees);
    parts_->renderer->ResetCameraClippingRange();
    parts_->window->Render();
    parts_->window->WaitForCompletion();
}

}  // namespace isoglass
