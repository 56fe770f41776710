// SPDX-License-Identifier: MIT
#include <algorithm>
#include <fstream>
#include <istream>
#include <new>
#include <system_error>
#include <vector>

#include "boxwood/error.hpp"
#include "io/bxw_format.hpp"
#include "io/bxw_materials.hpp"
#include "io/bxw_scene.hpp"

namespace boxwood {

namespace detail::bxw {

namespace {

/// Reads the header and refuses what this version cannot read.
Header read_header(std::istream& in, std::uint64_t size, const std::string& file) {
    Header header{};
    const auto has = [&](std::size_t bytes) { return static_cast<std::size_t>(in.gcount()) >= bytes; };
    in.read(reinterpret_cast<char*>(&header), sizeof header);
    if (!has(sizeof header.magic) || header.magic != magic) throw InputError(file, "header", "this is not a .bxw file");
    if (has(sizeof header.magic + sizeof header.version) && header.version > bxw_version) {
        throw InputError(file, "header",
                         "format version " + std::to_string(header.version) +
                             " is newer than this Boxwood, which reads " + std::to_string(bxw_version) +
                             "; build the tree again or use a newer Boxwood");
    }
    if (!has(sizeof header)) throw InputError(file, "header", "the file is truncated");
    if (header.version == 0) throw InputError(file, "header", "there is no such format version");
    if (header.version < bxw_version) {
        throw InputError(file, "header",
                         "format version " + std::to_string(header.version) +
                             " is older than this Boxwood, which reads " + std::to_string(bxw_version) +
                             "; build the tree again");
    }
    if (header.file_size != size) {
        throw InputError(file, "header",
                         (header.file_size > size ? "the file is truncated: " : "the file has trailing bytes: ") +
                             std::to_string(size) + " bytes, " + std::to_string(header.file_size) + " stated");
    }
    return header;
}

/// Reads the table and checks that the sections are the known ones and fill the file without a gap.
std::vector<SectionEntry> read_table(std::istream& in, const Header& header, const std::string& file) {
    const auto fail = [&](const std::string& what) { throw InputError(file, "section table", what); };
    if (header.section_count != section_kinds.size()) fail("has another number of sections than its version");
    std::vector<SectionEntry> table(section_kinds.size());
    const std::span bytes = std::as_writable_bytes(std::span(table));
    in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    if (static_cast<std::size_t>(in.gcount()) != bytes.size()) fail("is truncated");
    if (table_checksum(header, table) != header.checksum) fail("does not match its checksum: the file is corrupt");
    std::uint64_t offset = sizeof(Header) + bytes.size();
    for (std::size_t i = 0; i < table.size(); ++i) {
        const SectionEntry& entry = table[i];
        const SectionKind& kind = section_kinds[i];
        const std::string name(kind.name);
        if (entry.name != padded(kind.name)) fail("lacks section " + name + " at its place");
        if (entry.element_size != kind.element_size) fail("states a wrong element size for section " + name);
        if (entry.size % kind.element_size != 0) fail("states a part of an element for section " + name);
        // Both sums stay within the file, so none can wrap.
        if (entry.offset != offset || entry.size > header.file_size - offset) fail("misplaces section " + name);
        offset += entry.size;
    }
    if (offset != header.file_size) fail("does not account for every byte of the file");
    return table;
}

/// Reads the sections one after another, each straight into the memory it is for.
class SectionReader {
public:
    SectionReader(std::istream& in, std::span<const SectionEntry> table, const std::string& file)
        : in_(in), table_(table), file_(file) {}

    /// Starts section `name`, which must be the next one.
    void begin(std::string_view name) {
        entry_ = &table_[next_++];
        if (entry_->name != padded(name)) throw std::logic_error("sections are read out of order");
        left_ = entry_->size;
        sum_ = Checksum();
    }

    /// The next `count` elements. Refused before any memory is taken when the section has fewer.
    template <class T>
    std::vector<T> take(std::uint64_t count) {
        static_assert(std::is_trivially_copyable_v<T>);
        if (count > left_ / sizeof(T)) fail("has fewer elements than stated");
        std::vector<T> elements(static_cast<std::size_t>(count));
        // In chunks, so that the checksum finds the bytes still in cache.
        constexpr std::size_t chunk = std::size_t{1} << 20;
        auto* const bytes = reinterpret_cast<char*>(elements.data());
        const std::size_t size = elements.size() * sizeof(T);
        for (std::size_t done = 0; done < size;) {
            const std::size_t part = std::min(chunk, size - done);
            in_.read(bytes + done, static_cast<std::streamsize>(part));
            if (static_cast<std::size_t>(in_.gcount()) != part) fail("is truncated");
            sum_.add(bytes + done, part);
            done += part;
        }
        left_ -= size;
        return elements;
    }

    void end() const {
        if (left_ != 0) fail("has more elements than stated");
        if (sum_.value() != entry_->checksum) fail("does not match its checksum: the file is corrupt");
    }

    /// A section that is one array.
    template <class T>
    std::vector<T> all(std::string_view name) {
        begin(name);
        std::vector<T> elements = take<T>(left_ / sizeof(T));
        end();
        return elements;
    }

private:
    [[noreturn]] void fail(const char* what) const {
        throw InputError(file_, "section " + std::string(entry_->name.data()), what);
    }

    std::istream& in_;
    std::span<const SectionEntry> table_;
    const std::string& file_;
    std::size_t next_ = 0;
    const SectionEntry* entry_ = nullptr;
    std::uint64_t left_ = 0;
    Checksum sum_;
};

/// A section with an array of every mesh, as long as size(MeshSize) says.
template <class T, class Size, class Member>
void read_arrays(SectionReader& in, const char* section, SceneOutline& outline, Size size, Member member) {
    in.begin(section);
    for (std::size_t i = 0; i < outline.sizes.size(); ++i)
        member(outline.scene.meshes[i]) = in.take<T>(size(outline.sizes[i]));
    in.end();
}

/// Likewise of an attribute of vertices.
template <class T, class Member>
void read_attribute(SectionReader& in, const char* section, SceneOutline& outline, MeshPart part, Member member) {
    read_arrays<T>(
        in, section, outline, [part](const MeshSize& size) { return size.vertices_with(part); }, member);
}

Scene read_scene(SectionReader& in, const std::string& file) {
    SceneOutline outline = decode_scene(in.all<char>("scene"), file);
    read_arrays<glm::vec3>(
        in, "positions", outline, [](const MeshSize& size) { return size.vertices; },
        [](Mesh & mesh) -> auto& { return mesh.positions; });
    read_arrays<glm::uvec3>(
        in, "triangles", outline, [](const MeshSize& size) { return size.triangles; },
        [](Mesh & mesh) -> auto& { return mesh.triangles; });
    read_arrays<std::uint32_t>(
        in, "materials", outline, [](const MeshSize& size) { return size.triangles_with(mesh_materials); },
        [](Mesh & mesh) -> auto& { return mesh.materials; });
    read_attribute<glm::vec3>(
        in, "normals", outline, mesh_normals, [](Mesh & mesh) -> auto& { return mesh.normals; });
    read_attribute<glm::vec4>(
        in, "tangents", outline, mesh_tangents, [](Mesh & mesh) -> auto& { return mesh.tangents; });
    read_attribute<glm::vec2>(
        in, "uvs_0", outline, mesh_uvs_0, [](Mesh & mesh) -> auto& { return mesh.uvs[0]; });
    read_attribute<glm::vec2>(
        in, "uvs_1", outline, mesh_uvs_1, [](Mesh & mesh) -> auto& { return mesh.uvs[1]; });
    read_attribute<glm::vec4>(
        in, "colors", outline, mesh_colors, [](Mesh & mesh) -> auto& { return mesh.colors; });
    const std::vector<std::uint64_t> sizes = decode_materials(in.all<char>("looks"), file, outline.scene);
    in.begin("images");
    for (std::size_t i = 0; i < sizes.size(); ++i) outline.scene.images[i].bytes = in.take<std::byte>(sizes[i]);
    in.end();
    return std::move(outline.scene);
}

TreeImage read_tree(SectionReader& in, const std::string& file) {
    const std::vector<TreeRecord> records = in.all<TreeRecord>("tree");
    if (records.size() != 1) throw InputError(file, "section tree", "must have one element");
    const TreeRecord& record = records.front();
    if (record.layout > 1) throw InputError(file, "section tree", "names an unknown layout");
    if (record.levels < 1 || record.levels > 2) throw InputError(file, "section tree", "must have one or two levels");
    if (record.bounds >= all_bounds().size()) throw InputError(file, "section tree", "names unknown bounds");
    if (record.area_index > 2) throw InputError(file, "section tree", "names an unknown index of areas");
    constexpr std::array indexes = {AreaIndexKind::list, AreaIndexKind::octree, AreaIndexKind::kd};
    TreeImage tree;
    tree.area_index.kind = indexes[record.area_index];
    tree.bounds = static_cast<Bounds>(record.bounds);
    tree.layout = record.layout == 0 ? Layout::binary : Layout::wide8;
    tree.levels = record.levels == 1 ? Levels::one : Levels::two;
    tree.bottom_depth = record.bottom_depth;
    tree.top_depth = record.top_depth;
    tree.binary_nodes = in.all<BinaryNode>("binary_nodes");
    tree.oriented_nodes = in.all<OrientedNode>("oriented_nodes");
    tree.triangles = in.all<Triangle>("leaf_triangles");
    tree.wide_nodes = in.all<Wide8Node>("wide_nodes");
    tree.blocks = in.all<Triangle4>("leaf_blocks");
    tree.binary_top = in.all<BinaryNode>("binary_top");
    tree.oriented_top = in.all<OrientedNode>("oriented_top");
    tree.wide_top = in.all<Wide8Node>("wide_top");
    tree.instances = in.all<InstanceRecord>("instances");
    tree.first_triangles = in.all<std::uint32_t>("first_triangles");
    tree.areas = in.all<LocalArea>("areas");
    tree.area_index.nodes = in.all<AreaNode>("area_nodes");
    tree.area_index.items = in.all<std::uint32_t>("area_items");
    return tree;
}

} // namespace

BxwFile read(std::istream& in, std::uint64_t size, const std::string& file) {
    const Header header = read_header(in, size, file);
    const std::vector<SectionEntry> table = read_table(in, header, file);
    SectionReader sections(in, table, file);
    BxwFile result;
    result.scene = read_scene(sections, file);
    result.tree = read_tree(sections, file);
    validate(result.scene, file);
    result.tree.sphere = scene_sphere(result.scene);
    validate(result.tree, result.scene, file);
    return result;
}

} // namespace detail::bxw

BxwFile load_bxw(const std::filesystem::path& file) {
    std::error_code failure;
    const std::uint64_t size = std::filesystem::file_size(file, failure); // fails for folders, pipes and devices
    if (failure) throw InputError(file.string(), "", "cannot be read: " + failure.message());
    std::ifstream in(file, std::ios::binary);
    if (!in) throw InputError(file.string(), "", "cannot be opened");
    try {
        return detail::bxw::read(in, size, file.string());
    } catch (const std::bad_alloc&) { // a sparse file can be larger than any memory
        throw InputError(file.string(), "", "needs more memory than there is");
    }
}

bool is_bxw(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) return false; // reading a pipe would use up its bytes
    std::array<char, detail::bxw::magic.size()> start{};
    std::ifstream in(file, std::ios::binary);
    return in.read(start.data(), start.size()) && start == detail::bxw::magic;
}

} // namespace boxwood
