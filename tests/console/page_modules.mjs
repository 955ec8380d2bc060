// SPDX-License-Identifier: Apache-2.0
// The page's modules for node: as they lie there they are a browser's, which asks for no package.json
// to take a .js for a module. They are read from a copy that has one.
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";

const page = fileURLToPath(new URL("../../deploy/operator/console/page/", import.meta.url));
const copy = fs.mkdtempSync(path.join(os.tmpdir(), "lodesman-page-"));
process.on("exit", () => fs.rmSync(copy, { recursive: true, force: true }));
fs.writeFileSync(path.join(copy, "package.json"), '{"type": "module"}\n');
for (const name of fs.readdirSync(page)) if (name.endsWith(".js")) fs.copyFileSync(path.join(page, name), path.join(copy, name));

export const page_module = (name) => import(pathToFileURL(path.join(copy, name)));
