#include "app/app_test.h"
#include "unit/import/netcdf_writer.h"

#include <sys/stat.h>

namespace isoglass::test {
namespace {

/// Wrong input to the program as a whole: it says what is wrong and where, and leaves nothing.
class BadInput : public AppTest {
  protected:
    void write(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
    }

    /// Fails with status 1, names the place, and leaves the folder as it was.
    void expectRefused(const std::vector<std::string>& arguments, const std::string& place,
                       const RunOptions& options = {}) const {
        const auto before = files();
        const RunResult result = isoglass(arguments, options);
        EXPECT_EQ(result.status, 1) << result.err;
        EXPECT_TRUE(contains("\n" + result.err, "\nisoglass: error: ")) << result.err;
        EXPECT_TRUE(contains(result.err, place)) << place << " is not in: " << result.err;
        EXPECT_EQ(files(), before) << result.err;
    }

    /// A small NetCDF file: 2 x 2 x 3 x 4 samples.
    std::string netcdf(int format) const {
        NetcdfWriter writer(folder_ / "whole.nc", format);
        writeStandardVolume(writer).close();
        const std::string bytes = bytesOf("whole.nc");
        std::filesystem::remove(folder_ / "whole.nc");
        return bytes;
    }
};

constexpr int kClassic = 0;

TEST_F(BadInput, NetcdfCutShort) {
    for (const int format : {kClassic, NC_NETCDF4}) {
        const std::string whole = netcdf(format);
        for (int part = 0; part < 10; ++part) {
            SCOPED_TRACE(part);
            write("short.nc", whole.substr(0, whole.size() * static_cast<std::size_t>(part) / 10));
            expectRefused({"import", "short.nc", "-o", "new.vdb"}, "short.nc");
        }
    }
}

/// NetCDF has no checksum: a flipped bit of a sample is another sample. So either the file is refused, or
/// what comes of it is whole.
class FlippedNetcdf : public BadInput, public testing::WithParamInterface<int> {};

TEST_P(FlippedNetcdf, IsRefusedOrReadWhole) {
    const std::string whole = netcdf(GetParam());
    int refused = 0;
    constexpr std::size_t kFlips = 60;
    for (std::size_t i = 0; i < kFlips; ++i) {
        const std::size_t place = i * whole.size() / kFlips;
        SCOPED_TRACE(testing::Message() << "byte " << place);
        std::string damaged = whole;
        damaged[place] = static_cast<char>(damaged[place] ^ (1 << i % 8));
        write("damaged.nc", damaged);
        std::filesystem::remove(folder_ / "new.vdb");
        const RunResult result = isoglass({"import", "damaged.nc", "-o", "new.vdb"});
        if (result.status == 0) {
            run({"validate", "new.vdb"});
            continue;
        }
        ++refused;
        EXPECT_EQ(result.status, 1) << result.err;
        EXPECT_TRUE(contains("\n" + result.err, "\nisoglass: error: ")) << result.err;
        EXPECT_EQ(files(), (std::set<std::string>{"damaged.nc"})) << result.err;
    }
    EXPECT_GT(refused, 0) << "the first byte is the magic";
}

INSTANTIATE_TEST_SUITE_P(Formats, FlippedNetcdf, testing::Values(kClassic, NC_NETCDF4), [](const auto& test) {
    return test.param == kClassic ? "classic" : "netcdf4";
});

TEST_F(BadInput, SeriesDamagedAnywhereIsRefusedByEveryVerb) {
    importOcean();
    writeScene();
    const std::string whole = bytesOf("ocean.vdb");
    const auto expectAllRefuse = [&] {
        expectRefused({"info", "ocean.vdb"}, "ocean.vdb");
        expectRefused({"validate", "ocean.vdb"}, "ocean.vdb");
        expectRefused({"mesh", "ocean.vdb", "--iso", "15", "-o", "new.ply"}, "ocean.vdb");
        expectRefused({"mesh", "ocean.vdb", "--iso", "15", "--series", "-o", "new.csv"}, "ocean.vdb");
        expectRefused({"render", "scene.json", "-o", "new.png"}, "ocean.vdb");
    };
    for (int part = 0; part < 8; ++part) {
        SCOPED_TRACE(part);
        const std::size_t place = whole.size() * static_cast<std::size_t>(part) / 8;
        write("ocean.vdb", whole.substr(0, place));
        expectAllRefuse();
        std::string damaged = whole;
        damaged[place] = static_cast<char>(damaged[place] ^ 1 << part);
        write("ocean.vdb", damaged);
        expectAllRefuse();
    }
}

TEST_F(BadInput, WrongMagic) {
    for (const std::string bytes : {"", "text", "CDF", "PVM9\n2 2 2\n1\n12345678", "\x89HDF\r\n\x1a\n"}) {
        SCOPED_TRACE(bytes);
        write("magic.nc", bytes);
        write("magic.vdb", bytes);
        expectRefused({"import", "magic.nc", "-o", "new.vdb"}, "magic.nc");
        expectRefused({"info", "magic.vdb"}, "magic.vdb");
    }
}

TEST_F(BadInput, DimsThatDoNotMatchThePayload) {
    write("a.pvm", "PVM\n2 2 2\n1\n1234567");
    expectRefused({"import", "a.pvm", "-o", "new.vdb"}, "a.pvm");
    write("a.pvm", "PVM\n2 2 2\n1\n123456789");
    expectRefused({"import", "a.pvm", "-o", "new.vdb"}, "a.pvm");
    write("a.pvm", "PVM\n2 2 2\n1\n12345678");
    write("b.pvm", "PVM\n2 2 3\n1\n123456789012");
    expectRefused({"import", "a.pvm", "b.pvm", "-o", "new.vdb"}, "b.pvm");
}

TEST_F(BadInput, HugeDims) {
    for (const char* dims : {"1000000 1000000 1000000", "99999999999 2 2", "4294967296 4294967296 4294967296",
                             "-2 2 2", "0 2 2"}) {
        SCOPED_TRACE(dims);
        write("a.pvm", std::string("PVM\n") + dims + "\n1\n12345678");
        expectRefused({"import", "a.pvm", "-o", "new.vdb"}, "a.pvm");
    }
    NetcdfWriter writer(folder_ / "huge.nc");
    writer.dimension("time", 1).dimension("z", 1 << 20).dimension("y", 1 << 20).dimension("x", 1 << 20);
    writer.variable("F", NC_BYTE, {"time", "z", "y", "x"});
    const std::array<std::size_t, 4> chunk{1, 1, 1, 16};
    ASSERT_EQ(nc_def_var_chunking(writer.id(), 0, NC_CHUNKED, chunk.data()), NC_NOERR);
    writer.close();
    expectRefused({"import", "huge.nc", "-o", "new.vdb"}, "huge.nc");
}

TEST_F(BadInput, TimesThatDecreaseOrRepeat) {
    for (const char* name : {"a.pvm", "b.pvm", "c.pvm"}) write(name, "PVM\n2 2 2\n1\n12345678");
    for (const char* times : {"3,2,1", "1,1,2", "1,2,2", "1,nan,2"}) {
        SCOPED_TRACE(times);
        expectRefused({"import", "a.pvm", "b.pvm", "c.pvm", "-o", "new.vdb", "--times", times}, "--times");
    }
    for (const std::vector<double>& times : {std::vector<double>{6, 0}, std::vector<double>{6, 6}}) {
        NetcdfWriter writer(folder_ / "times.nc", kClassic);
        writeStandardVolume(writer).values("time", times).close();
        expectRefused({"import", "times.nc", "-o", "new.vdb"}, "times.nc");
    }
}

TEST_F(BadInput, SceneValuesAreNamedByTheirPointer) {
    importOcean();
    const auto sceneWith = [&](const std::string& more) {
        write("wrong.json",
              R"({"version": 1, "volumes": [{"series": "ocean.vdb", "surfaces": [{"iso": 20}]}], )" + more +
                  "}");
    };
    for (const auto& [more, pointer] :
         {std::pair(R"("image": {"size": "big"})", "(wrong.json, /image/size)"),
          std::pair(R"("image": {"size": [1, -2]})", "(wrong.json, /image/size/1)"),
          std::pair(R"("time": {"fps": []})", "(wrong.json, /time/fps)"),
          std::pair(R"("camera": {"path": [{"at": "now"}]})", "(wrong.json, /camera/path/0/at)"),
          std::pair(R"("camera": {"eie": 1})", "(wrong.json, /camera/eie); did you mean \"eye\"?"),
          std::pair(R"("time": {"from": )", "(wrong.json, line 1, column ")}) {
        sceneWith(more);
        expectRefused({"plan", "wrong.json"}, pointer);
        expectRefused({"render", "wrong.json", "-o", "new.png"}, pointer);
        expectRefused({"validate", "wrong.json"}, pointer);
    }
}

/// Places are asked for before the work: the series and scene here do not exist, and that is said only
/// where the place will do.
TEST_F(BadInput, PlacesAreCheckedFirst) {
    expectRefused({"mesh", "absent.vdb", "--iso", "1", "-o", "new.xyz"}, "new.xyz");
    expectRefused({"mesh", "absent.vdb", "--iso", "1", "-o", "no/new.ply"}, "(no)");
    expectRefused({"mesh", "absent.vdb", "--iso", "1", "--series", "-o", "new.ply"}, "new.ply");
    expectRefused({"mesh", "absent.vdb", "--iso", "1", "--series", "-o", "no/new.csv"}, "(no)");
    expectRefused({"render", "absent.json", "-o", "new.gif"}, "new.gif");
    for (const char* out : {"no/new.png", "no/f-{frame}.png", "no/new.mp4"})
        expectRefused({"render", "absent.json", "-o", out}, "(no)");
    expectRefused({"render", "absent.json", "-o", "no-{frame}/f.png"}, "{frame}");
    std::filesystem::create_directory(folder_ / "folder.png");
    expectRefused({"render", "absent.json", "-o", "folder.png"}, "folder.png");
}

/// Writing verbs, each with a place for its result.
std::vector<std::vector<std::string>> writingVerbs(const std::string& folder) {
    return {{"import", ISOGLASS_DATA_FOLDER "/ocean_excerpt.nc", "-o", folder + "/new.vdb"},
            {"mesh", "ocean.vdb", "--iso", "15", "-o", folder + "/new.ply"},
            {"mesh", "ocean.vdb", "--iso", "15", "--series", "-o", folder + "/new.csv"},
            {"render", "scene.json", "-o", folder + "/new.png"},
            {"render", "scene.json", "-o", folder + "/f-{frame}.png"},
            {"render", "scene.json", "-o", folder + "/new.mp4"}};
}

TEST_F(BadInput, FolderThatMayNotBeWritten) {
    importOcean();
    writeScene();
    std::filesystem::create_directory(folder_ / "locked");
    ::chmod((folder_ / "locked").c_str(), 0555);
    ::chmod(folder_.path().c_str(), 0755);
    const RunOptions asNobody{.dropPrivileges = true};
    if (isoglass({"info", "ocean.vdb"}, asNobody).status != 0)
        GTEST_SKIP() << "another user cannot run the program here";
    for (const auto& arguments : writingVerbs("locked")) {
        SCOPED_TRACE(arguments.back());
        expectRefused(arguments, "locked/", asNobody);
        EXPECT_TRUE(contains(isoglass(arguments, asNobody).err, "Permission denied"));
        EXPECT_TRUE(std::filesystem::is_empty(folder_ / "locked"));
    }
}

/// Not even the superuser makes files there.
TEST_F(BadInput, FolderWithoutFiles) {
    importOcean();
    writeScene();
    for (const auto& arguments : writingVerbs("/proc")) {
        SCOPED_TRACE(arguments.back());
        expectRefused(arguments, "(/proc/");
    }
}

TEST_F(BadInput, FullDeviceBehindAPicture) {
    importOcean();
    writeScene();
    std::filesystem::create_symlink("/dev/full", folder_ / "full.png");
    expectRefused({"render", "scene.json", "-o", "full.png"}, "full.png");
    EXPECT_TRUE(std::filesystem::is_character_file(folder_ / "full.png"));
}

TEST_F(BadInput, FullStandardOutput) {
    importOcean();
    writeScene();
    const std::vector<std::vector<std::string>> commands = {{"info", "ocean.vdb"},
                                                            {"info", "ocean.vdb", "--json"},
                                                            {"plan", "scene.json"},
                                                            {"validate", "scene.json"},
                                                            {"validate", "ocean.vdb", "--json"}};
    for (const auto& arguments : commands) {
        SCOPED_TRACE(arguments.front());
        expectRefused(arguments, "standard output", {.outFile = "/dev/full"});
    }
}

TEST_F(BadInput, TransparentVideo) {
    importOcean();
    write("glass.json", R"({"version": 1, "volumes": [{"series": "ocean.vdb", "surfaces": [{"iso": 20}]}],
                            "image": {"size": [32, 16], "background": "transparent"}})");
    expectRefused({"render", "glass.json", "-o", "new.mp4"}, "(glass.json, /image/background)");
}

}  // namespace
}  // namespace isoglass::test
