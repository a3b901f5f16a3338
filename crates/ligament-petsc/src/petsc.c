/* The equations of a body in PETSc: a fixed interface of numbers and arrays, so that no type of PETSc or MPI crosses it.

   All functions but `rank` and `n_ranks` are collective: every rank calls them in the same order. Points have numbers from 0 on over all
   ranks, those of a rank without a gap, and the same number of components each. Whatever fails ends all ranks with a message: none of
   them could go on alone. */

#include <petscksp.h>
#include <stdint.h>
#include <stdlib.h>
#include <time.h>

/* What ends an iteration: the entries of `limits` where there are any, a norm otherwise. */
typedef struct {
  const double *limits;
  double norm;
  double first_norm;
  double last_norm;
  Vec work;
} Limit;

typedef struct {
  Mat matrix;
  /* With the hierarchy or the factor, and with the stiffnesses of the points by themselves, which is always that of the matrix as it is. */
  KSP krylov, plain;
  Vec right, solution, work;
  PetscInt block_size, n_own;
} LigamentMatrix;

/* How an iteration ended; the last number stands in native.rs as well. */
enum { CONVERGED = 0, STALLED = 1, INDEFINITE = 2 };

/* Share of the stiffness of the points, each by itself, at which what resists a motion of them together is rounding, and steps to such a
   motion at most: as in the program's own iteration. */
static const double UNRESISTED = 1e-14;
enum { STEPS = 2000 };

static int world_rank = 0, world_size = 1;

static void fail(const char *what, const char *message)
{
  fprintf(stderr, "error: rank %d of %d: %s: %s\n", world_rank, world_size, what, message);
  fflush(stderr);
  MPI_Abort(MPI_COMM_WORLD, 1);
  abort();
}

static PetscErrorCode on_error(MPI_Comm comm, int line, const char *function, const char *file, PetscErrorCode code, PetscErrorType kind,
                               const char *message, void *context)
{
  (void)comm; (void)line; (void)file; (void)kind; (void)context;
  const char *text = NULL;
  PetscErrorMessage(code, &text, NULL);
  char words[1024];
  snprintf(words, sizeof words, "%s: %s (in %s)", text ? text : "it failed", message ? message : "", function ? function : "PETSc");
  fail("PETSc", words);
  return code;
}

/* Errors of PETSc come through `on_error`; what is left is a code without words. */
#define CHECK(call) \
  do { \
    if ((call) != 0) fail("PETSc", #call); \
  } while (0)

static PetscInt index_of(int64_t value)
{
  if (value < 0 || value > (int64_t)PETSC_MAX_INT) fail("PETSc", "the body is too large for the integers that this PETSc was built with");
  return (PetscInt)value;
}

static int count_of(int64_t value)
{
  if (value < 0 || value > INT32_MAX) fail("MPI", "a message is too long");
  return (int)value;
}

void ligament_start(void)
{
  int level;
  CHECK(MPI_Init_thread(NULL, NULL, MPI_THREAD_SERIALIZED, &level));
  CHECK(MPI_Comm_rank(MPI_COMM_WORLD, &world_rank));
  CHECK(MPI_Comm_size(MPI_COMM_WORLD, &world_size));
  if (level < MPI_THREAD_SERIALIZED) fail("MPI", "it does not allow calls from several threads, one at a time");
  /* Signals are the program's own business. */
  CHECK(PetscOptionsSetValue(NULL, "-no_signal_handler", "true"));
  /* Coarse matrices row by row: the usual product holds another copy of the coarse rows of neighbours. */
  if (world_size > 1) CHECK(PetscOptionsSetValue(NULL, "-matptap_via", "allatonce"));
  CHECK(PetscInitializeNoArguments());
  CHECK(PetscPushErrorHandler(on_error, NULL));
}

int ligament_rank(void) { return world_rank; }

int ligament_size(void) { return world_size; }

/* Ranks on the machine of this one. */
int ligament_size_here(void)
{
  MPI_Comm here;
  int count;
  CHECK(MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &here));
  CHECK(MPI_Comm_size(here, &count));
  CHECK(MPI_Comm_free(&here));
  return count;
}

/* Waits for all ranks to come here, so many seconds at most, or for ever with a negative number; tells whether all came. Without
   spinning: a rank may write results for long. */
int ligament_meet(double seconds)
{
  MPI_Request request;
  const struct timespec pause = {0, 2000000};
  int came = 0;
  double begun = MPI_Wtime();
  CHECK(MPI_Ibarrier(MPI_COMM_WORLD, &request));
  for (;;) {
    CHECK(MPI_Test(&request, &came, MPI_STATUS_IGNORE));
    if (came || (seconds >= 0 && MPI_Wtime() - begun > seconds)) return came;
    nanosleep(&pause, NULL);
  }
}

void ligament_end(void)
{
  CHECK(PetscPopErrorHandler());
  CHECK(PetscFinalize());
  CHECK(MPI_Finalize());
}

void ligament_abort(int code) { MPI_Abort(MPI_COMM_WORLD, code); }

/* The largest of each value over all ranks, in place. */
void ligament_all_reduce_max(double *values, int64_t n)
{
  CHECK(MPI_Allreduce(MPI_IN_PLACE, values, count_of(n), MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD));
}

/* The values of all ranks, `counts` of each, those of rank 0 first. */
void ligament_all_gather(const double *own, const int64_t *counts, double *all)
{
  int *lengths = malloc(2 * (size_t)world_size * sizeof *lengths);
  if (!lengths) fail("MPI", "out of memory");
  int *starts = lengths + world_size;
  int64_t taken = 0;
  for (int rank = 0; rank < world_size; rank++) {
    lengths[rank] = count_of(counts[rank]);
    starts[rank] = count_of(taken);
    taken += counts[rank];
  }
  CHECK(MPI_Allgatherv(own, lengths[world_rank], MPI_DOUBLE, all, lengths, starts, MPI_DOUBLE, MPI_COMM_WORLD));
  free(lengths);
}

/* Tells each rank `to` values of the own ones, those for rank 0 first, and takes `from` values of each. */
void ligament_all_to_all(const double *own, const int64_t *to, const int64_t *from, double *told)
{
  MPI_Request *requests = malloc(2 * (size_t)world_size * sizeof *requests);
  if (!requests) fail("MPI", "out of memory");
  int n = 0;
  for (int rank = 0; rank < world_size; told += from[rank++]) {
    if (from[rank]) CHECK(MPI_Irecv(told, count_of(from[rank]), MPI_DOUBLE, rank, 0, MPI_COMM_WORLD, &requests[n++]));
  }
  for (int rank = 0; rank < world_size; own += to[rank++]) {
    if (to[rank]) CHECK(MPI_Isend(own, count_of(to[rank]), MPI_DOUBLE, rank, 0, MPI_COMM_WORLD, &requests[n++]));
  }
  CHECK(MPI_Waitall(n, requests, MPI_STATUSES_IGNORE));
  free(requests);
}

/* Bytes of rank 0 to all. */
void ligament_broadcast(unsigned char *bytes, int64_t n)
{
  CHECK(MPI_Bcast(bytes, count_of(n), MPI_BYTE, 0, MPI_COMM_WORLD));
}

/* Bytes of a rank to another; these two call it. */
void ligament_transfer(unsigned char *bytes, int64_t n, int from, int to)
{
  if (world_rank == from) CHECK(MPI_Send(bytes, count_of(n), MPI_BYTE, to, 0, MPI_COMM_WORLD));
  else CHECK(MPI_Recv(bytes, count_of(n), MPI_BYTE, from, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE));
}

/* A matrix of `n_own` points of this rank and `n_all` of all, in blocks; `own_blocks` and `other_blocks` count the blocks in the rows of
   each own point by whose columns they are. */
void *ligament_matrix_new(int64_t block_size, int64_t n_own, int64_t n_all, const int64_t *own_blocks, const int64_t *other_blocks)
{
  LigamentMatrix *it = calloc(1, sizeof *it);
  PetscInt *counts;
  if (!it) fail("PETSc", "out of memory");
  it->block_size = index_of(block_size);
  it->n_own = index_of(n_own);
  index_of(n_all * block_size);
  CHECK(PetscMalloc1(2 * n_own + 1, &counts));
  for (int64_t row = 0; row < n_own; row++) {
    counts[row] = index_of(own_blocks[row]);
    counts[n_own + row] = index_of(other_blocks[row]);
  }
  CHECK(MatCreate(PETSC_COMM_WORLD, &it->matrix));
  CHECK(MatSetSizes(it->matrix, it->n_own * it->block_size, it->n_own * it->block_size, PETSC_DETERMINE, PETSC_DETERMINE));
  CHECK(MatSetBlockSize(it->matrix, it->block_size));
  CHECK(MatSetType(it->matrix, MATAIJ));
  CHECK(MatXAIJSetPreallocation(it->matrix, it->block_size, counts, counts + n_own, NULL, NULL));
  CHECK(PetscFree(counts));
  CHECK(MatSetOption(it->matrix, MAT_NEW_NONZERO_ALLOCATION_ERR, PETSC_TRUE));
  CHECK(MatSetOption(it->matrix, MAT_NO_OFF_PROC_ENTRIES, PETSC_TRUE));
  CHECK(MatSetOption(it->matrix, MAT_SYMMETRIC, PETSC_TRUE));
  CHECK(MatSetOption(it->matrix, MAT_SYMMETRY_ETERNAL, PETSC_TRUE));
  CHECK(MatCreateVecs(it->matrix, &it->right, &it->solution));
  CHECK(VecDuplicate(it->right, &it->work));
  return it;
}

void ligament_matrix_free(void *matrix)
{
  LigamentMatrix *it = matrix;
  CHECK(KSPDestroy(&it->krylov));
  CHECK(KSPDestroy(&it->plain));
  CHECK(VecDestroy(&it->right));
  CHECK(VecDestroy(&it->solution));
  CHECK(VecDestroy(&it->work));
  CHECK(MatDestroy(&it->matrix));
  free(it);
}

/* The blocks in the rows of a point and the columns of `n` points, shape (components, n, components), in the place of what was there.
   Not collective. */
void ligament_matrix_set(void *matrix, int64_t row, const int64_t *columns, int64_t n, const double *values)
{
  LigamentMatrix *it = matrix;
  PetscInt at = index_of(row), few[512], *places = few;
  if (n > 512) CHECK(PetscMalloc1(n, &places));
  for (int64_t k = 0; k < n; k++) places[k] = index_of(columns[k]);
  CHECK(MatSetValuesBlocked(it->matrix, 1, &at, index_of(n), places, values, INSERT_VALUES));
  if (places != few) CHECK(PetscFree(places));
}

void ligament_matrix_assemble(void *matrix)
{
  LigamentMatrix *it = matrix;
  CHECK(MatAssemblyBegin(it->matrix, MAT_FINAL_ASSEMBLY));
  CHECK(MatAssemblyEnd(it->matrix, MAT_FINAL_ASSEMBLY));
}

static void new_krylov(LigamentMatrix *it, KSP *krylov, const char *prefix, const char *kind)
{
  CHECK(KSPDestroy(krylov));
  CHECK(KSPCreate(PETSC_COMM_WORLD, krylov));
  CHECK(KSPSetOptionsPrefix(*krylov, prefix));
  CHECK(KSPSetOperators(*krylov, it->matrix, it->matrix));
  CHECK(KSPSetType(*krylov, kind));
}

/* The smoother on the points, whose matrix loses bonds while the hierarchy is kept. A bond of two points resists no motion by more than
   twice what it does while they move one at a time: with the stiffnesses of the points inverted no eigenvalue is above 2. An estimate may be
   too low where few bonds hold a point, and makes the whole preconditioner indefinite. */
static void bound_smoother(PC hierarchy)
{
  KSP smoother;
  PC of_points;
  PetscInt n_levels;
  CHECK(PCMGGetLevels(hierarchy, &n_levels));
  if (n_levels < 2) return;
  CHECK(PCMGGetSmoother(hierarchy, n_levels - 1, &smoother));
  CHECK(KSPGetPC(smoother, &of_points));
  CHECK(PCSetType(of_points, PCPBJACOBI));
  CHECK(KSPChebyshevSetEigenvalues(smoother, 2.0, 0.2));
  CHECK(KSPSetFromOptions(smoother));
}

/* A hierarchy of algebraic multigrid anew from the matrix as it is, with `n` motions that cost next to no energy, shape (n, own degrees of
   freedom). No element of the matrix couples more points than `n_coupled`. It is kept while the matrix changes, until the next call. */
void ligament_matrix_precondition(void *matrix, const double *motions, int64_t n, int64_t n_coupled)
{
  LigamentMatrix *it = matrix;
  PC preconditioner;
  MatNullSpace near;
  Vec *shapes;
  PetscInt length = it->n_own * it->block_size, kept = 0;
  CHECK(VecDuplicateVecs(it->right, index_of(n), &shapes));
  for (int64_t k = 0; k < n; k++) {
    double *values, size, rest;
    CHECK(VecGetArray(shapes[kept], &values));
    CHECK(PetscArraycpy(values, motions + k * length, length));
    CHECK(VecRestoreArray(shapes[kept], &values));
    CHECK(VecNorm(shapes[kept], NORM_2, &size));
    for (PetscInt other = 0; other < kept; other++) {
      double product;
      CHECK(VecDot(shapes[kept], shapes[other], &product));
      CHECK(VecAXPY(shapes[kept], -product, shapes[other]));
    }
    CHECK(VecNormalize(shapes[kept], &rest));
    /* A motion that the supports leave nothing of, or that is one of those before. */
    if (rest > 1e-8 * size) kept++;
  }
  CHECK(MatNullSpaceCreate(PETSC_COMM_WORLD, PETSC_FALSE, kept, shapes, &near));
  CHECK(MatSetNearNullSpace(it->matrix, near));
  CHECK(MatNullSpaceDestroy(&near));
  CHECK(VecDestroyVecs(index_of(n), &shapes));
  new_krylov(it, &it->krylov, "ligament_", KSPCG);
  CHECK(KSPSetNormType(it->krylov, KSP_NORM_UNPRECONDITIONED));
  CHECK(KSPGetPC(it->krylov, &preconditioner));
  CHECK(PCSetType(preconditioner, PCGAMG));
  /* Neither smoothed prolongation nor the squared graph, whose aggregates are larger: both cost more than the iterations they save. */
  CHECK(PCGAMGSetNSmooths(preconditioner, 0));
  CHECK(PCGAMGSetAggressiveLevels(preconditioner, 0));
  CHECK(KSPSetFromOptions(it->krylov));
  CHECK(KSPSetUp(it->krylov));
  PetscBool has_levels;
  CHECK(PetscObjectTypeCompare((PetscObject)preconditioner, PCGAMG, &has_levels));
  if (has_levels && n_coupled <= 2) bound_smoother(preconditioner);
  CHECK(KSPSetReusePreconditioner(it->krylov, PETSC_TRUE));
}

/* What MUMPS is to do: find vanishing pivots, and factorise the root itself, whose signs of pivots count. */
static void new_factor(LigamentMatrix *it)
{
  PC preconditioner;
  Mat factor;
  new_krylov(it, &it->krylov, "ligament_", KSPPREONLY);
  CHECK(KSPGetPC(it->krylov, &preconditioner));
  CHECK(PCSetType(preconditioner, PCCHOLESKY));
  CHECK(PCFactorSetMatSolverType(preconditioner, MATSOLVERMUMPS));
  CHECK(KSPSetFromOptions(it->krylov));
  CHECK(PCFactorSetUpMatSolverType(preconditioner));
  CHECK(PCFactorGetMatrix(preconditioner, &factor));
  CHECK(MatMumpsSetIcntl(factor, 24, 1));
  CHECK(MatMumpsSetIcntl(factor, 13, 1));
}

/* A factor L D L^T by MUMPS of the matrix as it is, over the symbolic factor of the one before; numbers of its negative, zero and positive
   pivots. */
void ligament_matrix_factorise(void *matrix, int64_t *inertia)
{
  LigamentMatrix *it = matrix;
  PC preconditioner;
  Mat factor;
  PetscInt negative, zero, positive;
  if (!it->krylov) new_factor(it);
  CHECK(KSPSetOperators(it->krylov, it->matrix, it->matrix));
  CHECK(KSPSetUp(it->krylov));
  CHECK(KSPGetPC(it->krylov, &preconditioner));
  CHECK(PCFactorGetMatrix(preconditioner, &factor));
  CHECK(MatGetInertia(factor, &negative, &zero, &positive));
  inertia[0] = negative;
  inertia[1] = zero;
  inertia[2] = positive;
}

/* The residual against the limits: the largest ratio over all ranks. */
static PetscErrorCode is_small(KSP krylov, PetscInt iteration, PetscReal norm, KSPConvergedReason *reason, void *context)
{
  Limit *limit = context;
  double ratio = 0;
  if (iteration == 0) limit->first_norm = norm;
  limit->last_norm = norm;
  *reason = KSP_CONVERGED_ITERATING;
  if (PetscIsInfOrNanReal(norm)) {
    *reason = KSP_DIVERGED_NANORINF;
    return 0;
  }
  if (!limit->limits) {
    if (norm <= limit->norm) *reason = KSP_CONVERGED_ATOL;
  } else {
    Vec residual;
    const double *values;
    PetscInt length;
    PetscCall(KSPBuildResidual(krylov, NULL, limit->work, &residual));
    PetscCall(VecGetLocalSize(residual, &length));
    PetscCall(VecGetArrayRead(residual, &values));
    for (PetscInt k = 0; k < length; k++) {
      double here = values[k] == 0 ? 0 : PetscAbsReal(values[k]) / limit->limits[k];
      if (here > ratio) ratio = here;
    }
    PetscCall(VecRestoreArrayRead(residual, &values));
    CHECK(MPI_Allreduce(MPI_IN_PLACE, &ratio, 1, MPI_DOUBLE, MPI_MAX, MPI_COMM_WORLD));
    if (ratio <= 1) *reason = KSP_CONVERGED_ATOL;
  }
  PetscInt most;
  PetscCall(KSPGetTolerances(krylov, NULL, NULL, NULL, &most));
  if (!*reason && iteration >= most) *reason = KSP_DIVERGED_ITS;
  return 0;
}

/* One solution for the forces in `right`, with its iterations. */
static int solve_once(LigamentMatrix *it, KSP krylov, Limit *limit, int64_t *iterations)
{
  KSPConvergedReason reason;
  PetscInt count;
  CHECK(KSPSetConvergenceTest(krylov, is_small, limit, NULL));
  CHECK(KSPSolve(krylov, it->right, it->solution));
  CHECK(KSPGetConvergedReason(krylov, &reason));
  CHECK(KSPGetIterationNumber(krylov, &count));
  /* What the test looks at ends with the caller. */
  CHECK(KSPSetConvergenceTest(krylov, KSPConvergedSkip, NULL, NULL));
  *iterations += count;
  return reason > 0 ? CONVERGED : STALLED;
}

/* Conjugate gradients with the stiffnesses of the points by themselves, inverted. */
static void prepare_plain(LigamentMatrix *it)
{
  PC of_points;
  if (!it->plain) {
    new_krylov(it, &it->plain, "ligament_plain_", KSPCG);
    CHECK(KSPSetNormType(it->plain, KSP_NORM_UNPRECONDITIONED));
    CHECK(KSPGetPC(it->plain, &of_points));
    CHECK(PCSetType(of_points, PCPBJACOBI));
    CHECK(KSPSetFromOptions(it->plain));
  }
  CHECK(KSPSetOperators(it->plain, it->matrix, it->matrix));
  CHECK(KSPSetUp(it->plain));
}

/* Whether the matrix resists some motion, to which the forces in `right` push, by no more than rounding; puts it into `motion`. Conjugate
   residuals (Saad 2003, section 6.8) of the motions z = M^-1 r alone, as in unresisted.rs. */
static PetscBool is_unresisted(LigamentMatrix *it, Vec motion)
{
  PC of_points;
  Vec own[5], stiffness, pushed, search, step, work;
  double curvature, of_points_now, at_first = 0, product;
  PetscBool found = PETSC_FALSE;
  CHECK(KSPGetPC(it->plain, &of_points));
  for (int k = 0; k < 5; k++) CHECK(VecDuplicate(motion, &own[k]));
  stiffness = own[0], pushed = own[1], search = own[2], step = own[3], work = own[4];
  CHECK(MatGetDiagonal(it->matrix, stiffness));
  CHECK(PCApply(of_points, it->right, motion));
  CHECK(MatMult(it->matrix, motion, pushed));
  CHECK(VecCopy(pushed, search));
  CHECK(VecDot(motion, pushed, &curvature));
  for (int steps = 0; steps < STEPS; steps++) {
    CHECK(VecPointwiseMult(work, stiffness, motion));
    CHECK(VecDot(work, motion, &of_points_now));
    if (steps == 0) at_first = of_points_now;
    /* What is left of a motion to the last digit: the body resists all of the forces. */
    if (!(of_points_now > 1e-28 * at_first)) break;
    if (curvature <= UNRESISTED * of_points_now) {
      found = PETSC_TRUE;
      break;
    }
    CHECK(PCApply(of_points, search, step));
    CHECK(VecDot(search, step, &product));
    CHECK(VecAXPY(motion, -curvature / product, step));
    CHECK(MatMult(it->matrix, motion, pushed));
    product = curvature;
    CHECK(VecDot(motion, pushed, &curvature));
    CHECK(VecAYPX(search, curvature / product, pushed));
  }
  for (int k = 0; k < 5; k++) CHECK(VecDestroy(&own[k]));
  return found;
}

/* Solves by iteration. A hierarchy of a body that is nearly a mechanism need not be definite, whatever the matrix is: where it does not come
   near enough, the points by themselves decide, and of a mechanism its motion. */
static int iterate(LigamentMatrix *it, Limit *limit, int64_t *iterations)
{
  if (solve_once(it, it->krylov, limit, iterations) == CONVERGED) return CONVERGED;
  prepare_plain(it);
  if (solve_once(it, it->plain, limit, iterations) == CONVERGED) return CONVERGED;
  Vec motion;
  CHECK(VecDuplicate(it->right, &motion));
  PetscBool found = is_unresisted(it, motion);
  if (found) CHECK(VecCopy(motion, it->solution));
  CHECK(VecDestroy(&motion));
  return found ? INDEFINITE : STALLED;
}

/* Solves for the forces at the own degrees of freedom, by the hierarchy or the factor that was made last. `limits` are sizes of the
   residual, or there are none and `norm` is one of its norm. Gives the iterations and the norms of the first and the last residual. Of an
   indefinite matrix the motions are one that it does not resist. */
int ligament_matrix_solve(void *matrix, const double *force, const double *limits, double norm, double *motions, int64_t *iterations,
                          double *norms)
{
  LigamentMatrix *it = matrix;
  Limit limit = {limits, norm, 0, 0, it->work};
  PetscInt length = it->n_own * it->block_size;
  double *values;
  const double *found;
  PetscBool is_factor;
  int end = CONVERGED;
  *iterations = 0;
  CHECK(VecGetArray(it->right, &values));
  CHECK(PetscArraycpy(values, force, length));
  CHECK(VecRestoreArray(it->right, &values));
  CHECK(PetscObjectTypeCompare((PetscObject)it->krylov, KSPPREONLY, &is_factor));
  if (is_factor) {
    KSPConvergedReason reason;
    CHECK(KSPSolve(it->krylov, it->right, it->solution));
    CHECK(KSPGetConvergedReason(it->krylov, &reason));
    if (reason <= 0) end = STALLED;
  } else {
    end = iterate(it, &limit, iterations);
  }
  CHECK(VecGetArrayRead(it->solution, &found));
  CHECK(PetscArraycpy(motions, found, length));
  CHECK(VecRestoreArrayRead(it->solution, &found));
  norms[0] = limit.first_norm;
  norms[1] = limit.last_norm;
  return end;
}
