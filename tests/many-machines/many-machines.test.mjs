// The job files of docs/many-machines, run where their schedulers are installed: Slurm on this machine with two processors of
// its own, GNU parallel; that of Kubernetes against its schema. `./test.sh --all` installs what they need.
import assert from 'node:assert/strict';
import { spawn, spawnSync } from 'node:child_process';
import { existsSync, mkdirSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { hostname, tmpdir } from 'node:os';
import { delimiter, dirname, join, resolve } from 'node:path';
import { after, before, describe, test } from 'node:test';
import { fileURLToPath } from 'node:url';

const here = dirname(fileURLToPath(import.meta.url));
const docs = resolve(here, '../../docs');
const binary = resolve(process.env.VITRINE_BINARY ?? join(here, '../../build/release/vitrine'));
const folder = mkdtempSync(join(tmpdir(), 'vitrine-machines-'));
after(() => rmSync(folder, { recursive: true, force: true }));

const has = (program) => spawnSync('sh', ['-c', `command -v ${program}`], { env: { ...process.env, PATH: `${process.env.PATH}:/usr/sbin` } }).status === 0;
const environment = { ...process.env, PATH: [dirname(binary), process.env.PATH, '/usr/sbin'].join(delimiter) };
const run = (command, more = {}) => spawnSync('bash', ['-c', command], { cwd: folder, env: { ...environment, ...more }, timeout: 120000 });
const pictures = (name) => Object.fromEntries(readdirSync(join(folder, name)).sort().map((file) => [file, readFileSync(join(folder, name, file)).toString('base64')]));
/** The settings of the job files, smaller. */
const smaller = (text) => text.replace('cpus-per-task=2', 'cpus-per-task=1').replace('1024,1024', '48,48').replace('--turntable 120', '--turntable 8').replace('--samples 16', '--samples 2');

before(() => {
  const result = run("vitrine render goblet -o 'whole/{frame}.png' --turntable 8 --samples 2 -r 48,48");
  assert.equal(result.status, 0, result.stderr.toString());
});

describe('Slurm', { skip: has('slurmctld') && has('slurmd') && process.getuid() === 0 ? false : 'slurm-wlm is not installed, or this is not root' }, () => {
  const daemons = [];
  const slurm = { SLURM_CONF: join(folder, 'slurm.conf') };

  before(async () => {
    mkdirSync(join(folder, 'state'));
    mkdirSync(join(folder, 'spool'));
    const port = 20000 + (process.pid % 20000);
    writeFileSync(slurm.SLURM_CONF, `ClusterName=vitrine
SlurmctldHost=${hostname()}
SlurmUser=root
SlurmdUser=root
AuthType=auth/none
CredType=cred/none
ProctrackType=proctrack/pgid
TaskPlugin=task/none
SwitchType=switch/none
MpiDefault=none
SelectType=select/cons_res
SelectTypeParameters=CR_CPU
ReturnToService=2
SlurmctldPort=${port}
SlurmdPort=${port + 1}
StateSaveLocation=${folder}/state
SlurmdSpoolDir=${folder}/spool
SlurmctldPidFile=${folder}/slurmctld.pid
SlurmdPidFile=${folder}/slurmd.pid
SlurmctldLogFile=${folder}/slurmctld.log
SlurmdLogFile=${folder}/slurmd.log
NodeName=${hostname()} CPUs=2 State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES State=UP
`);
    for (const name of ['slurmctld', 'slurmd']) {
      daemons.push(spawn(name, ['-D'], { env: { ...environment, ...slurm }, stdio: 'ignore' }));
      await new Promise((next) => setTimeout(next, 1500));
    }
  });
  after(() => daemons.forEach((daemon) => daemon.kill('SIGKILL')));

  test('a job array of four tasks, two at once: the same bytes as in one go', () => {
    writeFileSync(join(folder, 'job.sh'), smaller(readFileSync(join(docs, 'many-machines/slurm.sh'), 'utf8')));
    const result = run('sbatch --wait --output=task-%a.log job.sh', { ...slurm, OUT: 'slurm' });
    assert.equal(result.status, 0, result.stdout.toString() + result.stderr.toString());
    assert.deepEqual(pictures('slurm'), pictures('whole'));
    assert.match(readFileSync(join(folder, 'task-3.log'), 'utf8'), /part 3 of 4, by SLURM_ARRAY_TASK_ID[^]*2 of 2 pictures/);
  });
});

describe('GNU parallel', { skip: has('parallel') ? false : 'parallel is not installed' }, () => {
  test("the documentation's command: the same bytes as in one go", () => {
    const line = /`(parallel [^`]*)`/.exec(readFileSync(join(docs, 'many-machines.md'), 'utf8'))[1];
    const local = smaller(line.replace(/-S \S+ --workdir \. /, '')).replace("'turn/", "'parallel/").replace('--turntable 8', '--turntable 8 --samples 2 -r 48,48');
    const result = run(local);
    assert.equal(result.status, 0, result.stderr.toString());
    assert.deepEqual(pictures('parallel'), pictures('whole'));
  });
});

describe('Kubernetes', { skip: existsSync(join(here, 'node_modules')) ? false : 'its schema is not installed' }, () => {
  test('the job is one by the schema, and its parts are its completions', async () => {
    const { parse } = await import('yaml');
    const { Job } = await import('kubernetes-models/batch/v1/Job');
    const manifest = parse(readFileSync(join(docs, 'many-machines/kubernetes.yaml'), 'utf8'));
    new Job(manifest).validate();
    assert.throws(() => new Job({ ...manifest, spec: { ...manifest.spec, completions: 'four' } }).validate(), 'what is wrong is seen');
    assert.equal(manifest.spec.completionMode, 'Indexed');
    const { args } = manifest.spec.template.spec.containers[0];
    assert.equal(args[args.indexOf('--part') + 1], `auto/${manifest.spec.completions}`);
    // Its pods one after the other.
    for (let index = 0; index < manifest.spec.completions; ++index) {
      const words = args.map((word) => (word === '120' ? '8' : word === '16' ? '2' : word.replace('/out/', 'pods/')));
      const result = spawnSync(binary, [...words, '-r', '48,48'], { cwd: folder, env: { ...environment, JOB_COMPLETION_INDEX: String(index) } });
      assert.equal(result.status, 0, result.stderr.toString());
    }
    assert.deepEqual(pictures('pods'), pictures('whole'));
  });
});
