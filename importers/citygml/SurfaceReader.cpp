// SPDX-License-Identifier: GPL-3.0-or-later
#include "importers/citygml/SurfaceReader.h"

#include "importers/citygml/GmlPoints.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace reflet::citygml {

using namespace importers;

namespace {

constexpr int kDeepest = 64;  // of geometries in geometries

bool isPolygon(std::string_view name) {
    return name == "Polygon" || name == "PolygonPatch" || name == "Triangle" || name == "Rectangle";
}

/// Points and lines, and what describes a geometry without being one.
bool showsNothing(std::string_view name) {
    return name == "Point" || name == "MultiPoint" || name == "LineString" || name == "Curve" ||
           name == "CompositeCurve" || name == "MultiCurve" || name == "OrientableCurve" ||
           name == "metaDataProperty" || name == "boundedBy" || name == "controlPoint" ||
           name == "stopLines" || name == "breakLines";
}

}  // namespace

SurfaceReader::SurfaceReader(pugi::xml_node root, const Member& member,
                             const Surroundings& surroundings, CityPiece& piece)
    : m_root(root),
      m_member(member),
      m_around(surroundings),
      m_piece(piece),
      m_surfaces{piece.geometry.surfaces, piece.file.vertices},
      m_templates{piece.geometry.templates, piece.file.templateVertices},
      m_target(&m_surfaces),
      m_inlineCount(member.properties.size(), 0),
      m_referenceCount(member.properties.size(), 0) {
    m_own.addAllOf(root);
    if (surroundings.looksInside)
        noteIds();
}

void SurfaceReader::noteIds() {
    std::vector<pugi::xml_node> open{m_root};
    while (!open.empty()) {
        const pugi::xml_node node = open.back();
        open.pop_back();
        if (const std::string_view id = attributeOf(node, "id"); !id.empty())
            m_ids.try_emplace(id, node);
        for (const pugi::xml_node child : node.children()) {
            if (child.type() == pugi::node_element)
                open.push_back(child);
        }
    }
}

void SurfaceReader::note(const Context& context, Issue issue, std::string detail) {
    m_piece.report.note(context.owner, issue, std::move(detail));
}

void SurfaceReader::read() {
    const auto& objects = m_piece.file.objects;
    for (std::uint32_t o = 0; o < objects.size(); ++o) {
        for (std::uint32_t g = objects[o].firstGeometry;
             g < objects[o].firstGeometry + objects[o].geometryCount; ++g) {
            if (!m_piece.chosen[g])
                continue;
            Context context;
            context.owner = o;
            context.geometry = g;
            context.type = m_member.surfaceTypes[o];
            if (m_piece.file.geometries[g].type == GeometryType::Instance)
                readInstance(m_member.properties[g], context);
            else
                readGeometry(m_member.properties[g], context);
        }
    }
    readReferences();
    for (std::size_t g = 0; g < m_inlineCount.size(); ++g)
        m_piece.file.geometries[g].onlyReferences =
            m_inlineCount[g] == 0 && m_referenceCount[g] > 0;

    CityGeometry& geometry = m_piece.geometry;
    if (!geometry.templateBegin.empty())
        geometry.templateBegin.push_back(
            static_cast<std::uint32_t>(geometry.templates.surfaces.size()));
    geometry.usedBySurface.assign(m_piece.file.vertices.size(), false);
    for (const std::uint32_t point : geometry.surfaces.points)
        geometry.usedBySurface[point] = true;
}

/// Walks down from a property or a geometry to its polygons.
void SurfaceReader::readGeometry(pugi::xml_node node, Context context) {
    const std::string_view name = localNameOf(node);
    if (showsNothing(name) || context.depth++ > kDeepest)
        return;
    context.dimension = dimensionOf(node, context.dimension);
    if (const std::string_view href = attributeOf(node, "href"); !href.empty()) {
        if (m_followed.insert(node.hash_value()).second)
            m_references.push_back({std::string(href), context});
        return;
    }
    lookUp(node, context);
    if (isPolygon(name)) {
        readPolygon(node, context);
        return;
    }
    const bool textured = name == "TexturedSurface";  // CityGML 1
    if ((textured || name == "OrientableSurface") && attributeOf(node, "orientation") == "-")
        context.reversed = !context.reversed;
    if (textured)
        lookAtTexturedSurface(node, context);
    for (const pugi::xml_node child : node.children()) {
        if (child.type() == pugi::node_element)
            readGeometry(child, context);
    }
}

/// References come last: what they name may be read where it is defined. They may lead to more.
void SurfaceReader::readReferences() {
    for (std::size_t i = 0; i < m_references.size(); ++i) {
        const Reference reference = m_references[i];  // the list grows
        follow(reference);
    }
    m_references.clear();
}

pugi::xml_node SurfaceReader::definitionOf(std::string_view id) {
    if (const auto known = m_ids.find(id); known != m_ids.end())
        return known->second;
    const auto outside = m_around.definitions.find(id);
    return outside == m_around.definitions.end() ? pugi::xml_node()
                                                 : firstElement(*outside->second);
}

void SurfaceReader::follow(const Reference& reference) {
    if (reference.context.geometry < m_referenceCount.size())
        ++m_referenceCount[reference.context.geometry];
    const pugi::xml_node node = definitionOf(idOfReference(reference.id));
    if (!node) {
        note(reference.context, Issue::ReferenceMissing, fmt::format("{:.80}", reference.id));
        return;
    }
    if (!m_followed.insert(node.hash_value()).second)
        return;  // there is nothing in it that has not been read
    Context context = reference.context;
    context.copy = true;
    readGeometry(node, context);
}

// ---- polygons ----

void SurfaceReader::readPolygon(pugi::xml_node node, const Context& context) {
    const bool city = m_target == &m_surfaces;
    if (city && !m_readPolygons.insert(node.hash_value()).second)
        return;
    if (city && !context.copy && context.geometry < m_inlineCount.size())
        ++m_inlineCount[context.geometry];
    std::vector<Ring> rings;
    const bool sound = readRings(node, context, rings);
    if (city && !context.copy) {
        std::size_t points = 0;
        for (const Ring& ring : rings)
            points += ring.points.size();
        ++m_piece.geometry.writtenSurfaces;
        m_piece.geometry.writtenTriangles += nominalTriangles(points, rings.size());
    }
    if (sound)
        addSurface(rings, context);
}

bool SurfaceReader::readRings(pugi::xml_node polygon, const Context& context,
                              std::vector<Ring>& rings) {
    for (const bool outer : {true, false}) {
        for (const pugi::xml_node child : polygon.children()) {
            const std::string_view name = localNameOf(child);
            const bool isOuter = name == "exterior" || name == "outerBoundaryIs";
            const bool isInner = name == "interior" || name == "innerBoundaryIs";
            if ((outer ? isOuter : isInner) && !readRing(child, context, rings))
                return false;
        }
        if (outer && rings.empty()) {
            note(context, Issue::BadGeometry, "a polygon has no exterior");
            return false;
        }
    }
    return true;
}

bool SurfaceReader::readRing(pugi::xml_node property, const Context& context,
                             std::vector<Ring>& rings) {
    Ring ring;
    ring.node = firstElement(property);
    const std::string problem = readPoints(ring.node, context.dimension, ring.points);
    if (!problem.empty() || ring.points.empty()) {
        note(context, Issue::BadCoordinates, problem.empty() ? "a ring has no points" : problem);
        return false;
    }
    ring.written = ring.points.size();
    if (ring.points.size() > 1 && ring.points.front() == ring.points.back())
        ring.points.pop_back();
    else
        note(context, Issue::OpenRing);
    rings.push_back(std::move(ring));
    return true;
}

std::uint32_t SurfaceReader::vertexNumber(const glm::dvec3& point) {
    const auto next = static_cast<std::uint32_t>(m_target->vertices.size());
    const auto [known, isNew] = m_target->numberOf.try_emplace({point.x, point.y, point.z}, next);
    if (isNew)
        m_target->vertices.push_back(point);
    return known->second;
}

void SurfaceReader::addSurface(const std::vector<Ring>& rings, const Context& context) {
    SurfaceSoup& soup = m_target->soup;
    SurfaceSoup::Surface surface;
    surface.owner = m_target == &m_surfaces
                        ? context.owner
                        : static_cast<std::uint32_t>(m_piece.file.templates.size() - 1);
    surface.firstRing = static_cast<std::uint32_t>(soup.ringEnds.size());
    surface.ringCount = static_cast<std::uint32_t>(rings.size());
    surface.type = context.type;
    for (const Ring& ring : rings) {
        const auto count = ring.points.size();
        for (std::size_t i = 0; i < count; ++i)
            soup.points.push_back(vertexNumber(ring.points[context.reversed ? count - 1 - i : i]));
        soup.ringEnds.push_back(static_cast<std::uint32_t>(soup.points.size()));
    }
    surface.material = context.material;
    if (context.texture != kNone)
        addTexture(rings, context, surface);
    soup.surfaces.push_back(surface);
}

// ---- looks ----

/// What is said about a surface holds for all in it of which nothing else is said; what stands in
/// the member counts more than what stands beside it.
void SurfaceReader::lookUp(pugi::xml_node node, Context& context) {
    if (m_own.empty() && m_around.appearances.empty())
        return;
    const std::string_view id = attributeOf(node, "id");
    if (id.empty())
        return;
    for (const Appearances* source : {&m_around.appearances, &std::as_const(m_own)}) {
        const Appearances::Look* look = source->find(id);
        if (look == nullptr)
            continue;
        if (look->material != kNone)
            context.material = materialNumber(*source, look->material);
        if (look->texture != kNone) {
            context.texture = look->texture;
            context.look = look;
            context.source = source;
        }
    }
}

/// What the surface says of itself counts most.
void SurfaceReader::lookAtTexturedSurface(pugi::xml_node node, Context& context) {
    const Appearances::Look& look = m_own.addTexturedSurface(node);
    if (look.material != kNone)
        context.material = materialNumber(m_own, look.material);
    if (look.texture != kNone) {
        context.texture = look.texture;
        context.look = &look;
        context.source = &m_own;
    }
}

std::uint32_t SurfaceReader::textureNumber(const Appearances& source, std::uint32_t texture) {
    auto& textures = m_piece.file.textures;
    const auto next = static_cast<std::uint32_t>(textures.size());
    const auto [known, isNew] = m_textureOf.try_emplace({&source, texture}, next);
    if (isNew)
        textures.push_back(source.textures()[texture]);
    return known->second;
}

std::uint32_t SurfaceReader::materialNumber(const Appearances& source, std::uint32_t material) {
    auto& materials = m_piece.file.materials;
    const auto next = static_cast<std::uint32_t>(materials.size());
    const auto [known, isNew] = m_materialOf.try_emplace({&source, material}, next);
    if (isNew)
        materials.push_back(source.materials()[material]);
    return known->second;
}

void SurfaceReader::addTexture(const std::vector<Ring>& rings, const Context& context,
                               SurfaceSoup::Surface& surface) {
    SurfaceSoup& soup = m_target->soup;
    const std::size_t firstUv = soup.uvs.size();
    const std::size_t firstVertex = m_piece.file.textureVertices.size();
    const auto leaveOut = [&](const char* why) {
        soup.uvs.resize(firstUv);
        m_piece.file.textureVertices.resize(firstVertex);
        note(context, Issue::TextureBroken, why);
    };
    ImagePlaces::Place place;
    const Georeference* georeference = context.source->georeference(context.texture);
    if (georeference != nullptr) {
        place =
            m_around.images.place(context.source->textures()[context.texture].image, *georeference);
        if (!place.found)
            place.projection.emplace();  // any: a missing image is told of once, for all
        if (!place.projection)
            return leaveOut("its image does not say where it lies");
    }
    std::size_t firstOfRing = 0;
    for (const Ring& ring : rings) {
        if (!(place.projection ? addUvInPlane(ring, context, *place.projection)
                               : addUv(ring, context, firstOfRing)))
            return leaveOut("no coordinate for each point of a ring");
        firstOfRing += ring.written;
    }
    surface.texture = textureNumber(*context.source, context.texture);
    surface.firstUv = static_cast<std::uint32_t>(firstUv);
}

void SurfaceReader::addUv(const glm::vec2& uv) {
    m_target->soup.uvs.push_back(static_cast<std::uint32_t>(m_piece.file.textureVertices.size()));
    m_piece.file.textureVertices.push_back(uv);
}

/// By where the image lies. What its own file says is meant east first; the points may not be.
bool SurfaceReader::addUvInPlane(const Ring& ring, const Context& context,
                                 const PlaneProjection& projection) {
    constexpr double kNear = 1.0;  // widths of the image beside it
    const auto isNear = [](const glm::dvec2& uv) {
        return uv.x > -kNear && uv.x < 1.0 + kNear && uv.y > -kNear && uv.y < 1.0 + kNear;
    };
    const glm::dvec3& first = ring.points.front();
    const bool swapped = projection.eastFirst && !isNear(projection({first.x, first.y})) &&
                         isNear(projection({first.y, first.x}));
    const std::size_t count = ring.points.size();
    for (std::size_t i = 0; i < count; ++i) {
        const glm::dvec3& p = ring.points[context.reversed ? count - 1 - i : i];
        const glm::vec2 uv(projection(swapped ? glm::dvec2(p.y, p.x) : glm::dvec2(p.x, p.y)));
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y))
            return false;
        addUv(uv);
    }
    return true;
}

/// The coordinates of one ring: by a list, or by a matrix and the place of its points. False:
/// there are none.
bool SurfaceReader::addUv(const Ring& ring, const Context& context, std::size_t firstOfRing) {
    const std::size_t count = ring.points.size();
    const auto& matrix = context.look->worldToTexture;
    const std::vector<glm::vec2>& own = context.look->uv;
    const std::vector<glm::vec2>* list =
        matrix || !own.empty()
            ? nullptr
            : context.source->ring(attributeOf(ring.node, "id"), context.texture);
    const bool listed = list != nullptr && (list->size() == count || list->size() == ring.written);
    if (!matrix && !listed && own.size() < firstOfRing + count)
        return false;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t at = context.reversed ? count - 1 - i : i;
        glm::vec2 uv(0.0F);
        if (matrix) {
            const glm::dvec3& p = ring.points[at];
            const auto row = [&](std::size_t r) {
                const double* m = matrix->data() + 4 * r;
                return m[0] * p.x + m[1] * p.y + m[2] * p.z + m[3];
            };
            const double w = row(2);
            if (!(std::abs(w) > 1e-12))
                return false;
            uv = glm::vec2(glm::dvec2(row(0), row(1)) / w);
        } else {
            uv = listed ? (*list)[at] : own[firstOfRing + at];
        }
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y))
            return false;
        addUv(uv);
    }
    return true;
}

// ---- implicit geometry ----

void SurfaceReader::readInstance(pugi::xml_node property, const Context& context) {
    const pugi::xml_node implicit = firstElement(property);
    std::vector<double> matrix;
    const pugi::xml_node text = childOf(implicit, "transformationMatrix");
    if (!text || !readNumbers(text.child_value(), matrix) || matrix.size() != 16) {
        note(context, Issue::BadInstance, "the matrix is not 16 numbers");
        return;
    }
    std::vector<glm::dvec3> anchor;
    const std::string problem =
        readPoints(childOf(implicit, "referencePoint"), context.dimension, anchor);
    if (!problem.empty() || anchor.size() != 1) {
        note(context, Issue::BadInstance, "the reference point is not one point");
        return;
    }
    const std::uint32_t number = templateOf(implicit, context);
    if (number == kNone)
        return;
    InstanceRecord instance;
    instance.object = context.owner;
    instance.templateIndex = number;
    instance.anchor = vertexNumber(anchor.front());
    std::copy(matrix.begin(), matrix.end(), instance.matrix.begin());
    m_piece.geometry.instances.push_back(instance);
}

/// The number of the template that an ImplicitGeometry shows; kNone, and a note: there is none.
std::uint32_t SurfaceReader::templateOf(pugi::xml_node implicit, const Context& context) {
    pugi::xml_node relative = childOf(implicit, "relativeGMLGeometry");
    if (!relative)
        relative = childOf(implicit, "relativeGeometry");  // CityGML 3
    if (!relative) {
        const std::string_view library = childOf(implicit, "libraryObject").child_value();
        note(context, library.empty() ? Issue::BadInstance : Issue::LibraryObject,
             library.empty() ? "no geometry is named" : fmt::format("{:.80}", library));
        return kNone;
    }
    const std::string_view href = attributeOf(relative, "href");
    const pugi::xml_node geometry =
        href.empty() ? firstElement(relative) : definitionOf(idOfReference(href));
    if (!geometry) {
        note(context, Issue::ReferenceMissing, fmt::format("{:.80}", href));
        return kNone;
    }
    if (const auto known = m_templateOf.find(geometry.hash_value()); known != m_templateOf.end())
        return known->second;
    return makeTemplate(geometry, context);
}

std::uint32_t SurfaceReader::makeTemplate(pugi::xml_node geometry, const Context& context) {
    auto& templates = m_piece.file.templates;
    const auto number = static_cast<std::uint32_t>(templates.size());
    GeometryOutline outline;
    outline.type = GeometryType::MultiSurface;
    outline.lod = m_piece.file.geometries[context.geometry].lod;
    templates.push_back(std::move(outline));
    m_templateOf.emplace(geometry.hash_value(), number);
    m_piece.geometry.templateBegin.push_back(
        static_cast<std::uint32_t>(m_piece.geometry.templates.surfaces.size()));
    Context inside = context;
    inside.geometry = kNone;
    // References in the city wait; those in the template are followed now.
    std::vector<Reference> waiting = std::exchange(m_references, {});
    auto followed = std::exchange(m_followed, {});
    m_target = &m_templates;
    readGeometry(geometry, inside);
    readReferences();
    m_target = &m_surfaces;
    m_references = std::move(waiting);
    m_followed = std::move(followed);
    return number;
}

}  // namespace reflet::citygml
